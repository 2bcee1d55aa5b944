#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <random>
#include <string>

#include "db/database.hpp"
#include "db/fleet/fleet_store.hpp"
#include "server/runtime/fleet_runtime.hpp"
#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::server::testing {

/// What was asked of the fleet and answered, whichever server answered.
struct Ledger {
    struct Asked {
        bool accepted = false;
        bool refused = false;  // the last answer was that nothing was changed
        fleet::JobOrderId order;
        std::int64_t revision = 0;  // newest one that was acknowledged
    };
    std::map<std::string, Asked> orders;  // by Idempotency-Key
    std::int64_t last_event = 0;          // newest one that was published
    int gaps = 0;                         // events published out of order
};

/// The server's fleet on a real database with obedient vehicles, without sockets; the calling
/// thread is its network thread. Every choice comes from the seed of a step.
class StoredFleet {
public:
    using Vehicles = std::map<plant::VehicleId, fleet::testing::FakeVehicle>;

    /// `vehicles`: where an earlier server left them; empty: at home.
    StoredFleet(const std::string& path, Ledger& ledger, Time now, Vehicles vehicles = {});
    ~StoredFleet();

    /// One of the things people and vehicles do; every one is waited for.
    void step(int number);
    /// A new order, until it is accepted; false when it is not within some 20 s.
    bool works_again();
    void pass(Duration time) { clock_.at += time.count(); }
    Time now() const { return clock_.now(); }
    const Vehicles& vehicles() const { return vehicles_; }

private:
    struct ManualClock : Clock {
        std::atomic<std::int64_t> at{0};
        Time now() const override { return time_from_ns(at); }
    };

    template <class F>
    auto ask(F f) -> Result<std::invoke_result_t<F, fleet::Fleet&, Time>>;
    void run_delivered_until(const std::function<bool()>& done);
    void publish(const FleetRuntime::Published& batch);
    void report_vehicles();
    void create(const std::string& key, std::mt19937& random);
    void change(std::mt19937& random);
    void let_go();
    void await_store();

    Ledger& ledger_;
    ManualClock clock_;
    Metrics metrics_;
    Vehicles vehicles_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<FleetRuntime::Job> delivered_;
    db::Database database_;
    db::FleetStore store_;
    std::unique_ptr<FleetRuntime> runtime_;
};

}  // namespace pulseline::server::testing
