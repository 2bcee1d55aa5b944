#pragma once

#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "core/fleet/legs/leg_plan_answerer.hpp"
#include "server/base/server_clock.hpp"
#include "server/base/stop_limit.hpp"
#include "server/runtime/locked_history.hpp"
#include "server/server.hpp"
#include "server/sessions/context.hpp"
#include "server/sessions/listener.hpp"

/// The server's parts, for its own sources only.
namespace pulseline::server {

/// Logs the exception that a loop ended with, if any.
void log_end(const std::exception_ptr& error);

class Server::Impl : public api::Service {
public:
    Impl(Options options, Parts parts)
        : options_(std::move(options)),
          parts_(parts),
          io_(std::make_unique<net::io_context>(1)),
          acceptor_(*io_),
          signals_(*io_) {}
    ~Impl() override;

    Status start();
    void run();
    void begin_stop();
    void limit_stop();

    std::optional<Error> not_ready() const override;
    std::string metrics() const override;
    std::string version() const override { return kVersion; }

    Status listen();
    void make_parts(const fleet::StoredFleet& stored);
    void make_context();
    void begin_loops();
    FleetRuntime::Ports runtime_ports();
    VehicleGateway::Ports gateway_ports();
    StreamHub::Ports hub_ports();
    void plan_legs(const std::vector<fleet::LegPlanQuestion>& questions);
    net::awaitable<void> beat();
    net::awaitable<void> keep_uses();
    net::awaitable<void> give_memory_back();
    net::awaitable<void> follow_clock();
    void tell_of_clock(bool differs, Duration ahead);
    net::awaitable<void> finish();

    // Outlives all that may hold the end up.
    StopLimit stop_limit_;
    Options options_;
    Parts parts_;
    // Sessions live in io_; the destructor ends it before what they use.
    std::unique_ptr<net::io_context> io_;
    std::optional<tcp::acceptor> acceptor_;
    std::optional<net::signal_set> signals_;
    Address address_;
    std::unique_ptr<Tls> tls_;
    api::Documents documents_;
    Metrics metrics_;
    CameraStore images_;
    std::optional<ServerClock> clock_;
    ClockWatch clock_watch_;
    std::optional<StreamHub> hub_;
    std::optional<FleetRuntime> runtime_;
    std::optional<api::access::AccessControl> access_;
    std::optional<VehicleGateway> gateway_;
    std::optional<LockedHistory> history_;
    TrustedProxies proxies_;
    SignInGate gate_;
    // The threads beside the fleet's, each with a queue of its own that is dropped at the end.
    std::vector<std::unique_ptr<Lane>> lanes_;
    Lane* encoders_ = nullptr;         // one of them
    Lane* leg_plans_ = nullptr;        // another
    fleet::LegPlanAnswerer answerer_;  // of that one
    std::optional<Context> context_;
    bool stopping_ = false;
    int pausing_ = 0;  // loops that have thrown and do not run now
    std::thread stopper_;
};

}  // namespace pulseline::server
