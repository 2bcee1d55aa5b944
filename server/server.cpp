#include "server/server.hpp"

#include <malloc.h>
#include <sodium.h>

#include <cmath>
#include <csignal>

#include "api/http/documents.hpp"
#include "core/base/crash_point.hpp"
#include "core/fleet/legs/leg_plan_answerer.hpp"
#include "server/context.hpp"
#include "server/keep_running.hpp"
#include "server/listener.hpp"
#include "server/locked_history.hpp"
#include "server/origins.hpp"
#include "server/server_clock.hpp"
#include "server/stop_limit.hpp"

namespace pulseline::server {
namespace {

constexpr auto kStopGrace = std::chrono::milliseconds(1500);  // of sessions
constexpr auto kLongestStop = std::chrono::seconds(8);        // of all, a disk that hangs included
constexpr auto kKeepUses = std::chrono::seconds(30);
constexpr auto kGiveBack = std::chrono::seconds(60);
constexpr auto kFollowClock = std::chrono::seconds(1);
constexpr int kStopsShown = 50;
constexpr int kNiceOfHeavy = 5;
constexpr int kNiceOfStrangers = 10;  // behind all else, but not starved on a busy machine

std::uint64_t random_seed() {
    std::uint64_t seed = 0;
    randombytes_buf(&seed, sizeof seed);
    return seed;
}

void log_end(const std::exception_ptr& error) {
    if (error) log::error("loop_threw", {{"what", what(error)}});
}

}  // namespace

const char* const kVersion = PULSELINE_VERSION;

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
    std::optional<access::AccessControl> access_;
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

Server::Impl::~Impl() {
    if (stopper_.joinable()) stopper_.join();
    if (runtime_) runtime_->stop();
    lanes_.clear();
    acceptor_.reset();
    signals_.reset();
    io_.reset();
}

Status Server::Impl::start() {
    auto address = parse_address(options_.listen);
    if (!address) return fail(address.error());
    address_ = *address;
    if (auto exposed = check_exposure(options_, address_); !exposed) return exposed;
    auto proxies = TrustedProxies::parse(options_.behind_proxy);
    if (!proxies) return fail(proxies.error());
    proxies_ = std::move(*proxies);
    if (options_.tls()) {
        auto tls = make_tls(options_, address_.host);
        if (!tls) return fail(tls.error());
        tls_ = std::move(*tls);
    }
    auto acceptor = open_acceptor(*io_, address_);
    if (!acceptor) return fail(acceptor.error());
    acceptor_ = std::move(*acceptor);
    address_.port = acceptor_->local_endpoint().port();

    crash_point(CrashPoint::kStartBeforeLoad);
    auto stored = parts_.store.load();
    clock_.emplace(stored.last_time);
    documents_ = api::make_documents(parts_.plant);
    hub_.emplace(parts_.plant, images_, *clock_, metrics_);
    fleet::StopQuery newest;
    newest.limit = kStopsShown;
    hub_->start(parts_.history.stops(newest), stored.last_event_seq);
    runtime_.emplace(runtime_ports(), random_seed());
    access_.emplace(
        parts_.access,
        [this](const access::Change& change) {
            runtime_->write([this, change] { access::apply(parts_.access, change); });
        },
        clock_->now(), stored.last_time);
    gateway_.emplace(gateway_ports());
    history_.emplace(parts_.history);
    const Limits& limits = options_.limits;
    const auto lane = [this](std::size_t waiting, std::size_t of_one, int nice) -> Lane& {
        return *lanes_.emplace_back(std::make_unique<Lane>(Lane::Limits{waiting, of_one, nice}));
    };
    Lane& lists = lane(limits.lists_waiting, limits.lists_of_one, 0);
    Lane& heavy = lane(limits.heavy_waiting, limits.heavy_of_one, kNiceOfHeavy);
    Lane& workers = lane(limits.lists_waiting, limits.lists_of_one, 0);
    Lane& known_sign_ins = lane(limits.sign_ins_waiting, limits.sign_ins_waiting, kNiceOfHeavy);
    Lane& stranger_sign_ins =
        lane(limits.sign_ins_waiting, limits.sign_ins_waiting, kNiceOfStrangers);
    Lane& planners = lane(limits.planners_waiting, limits.planners_waiting, kNiceOfHeavy);
    Lane& encoders = lane(limits.encoders_waiting, limits.encoders_waiting, 0);
    encoders_ = &encoders;
    // Vehicles wait for it: not behind the previews of those who only ask.
    leg_plans_ = &lane(limits.planners_waiting, limits.planners_waiting, 0);
    for (const auto& name : access_->signed_in(clock_->now())) gate_.remember(name, clock_->now());
    context_.emplace(Context{options_,
                             parts_.plant,
                             documents_,
                             *this,
                             *clock_,
                             metrics_,
                             images_,
                             *runtime_,
                             *access_,
                             *history_,
                             *hub_,
                             *gateway_,
                             api::AccessPolicy{allowed_origins(options_, address_)},
                             *io_,
                             lists,
                             heavy,
                             workers,
                             planners,
                             encoders,
                             known_sign_ins,
                             stranger_sign_ins,
                             gate_,
                             proxies_,
                             StopList{},
                             Quota(options_.limits.connections_per_peer),
                             Quota(options_.limits.streams_per_user),
                             Quota(limits.bodies_of_one_bytes, limits.bodies_bytes),
                             0});
    if (auto started = runtime_->start(std::move(stored)); !started) return started;
    hub_->connect(hub_ports());
    hub_->resubscribe_all();
    net::co_spawn(*io_,
                  keep_running("accept", *io_, pausing_,
                               [this] { return accept_loop(*context_, *acceptor_, tls_.get()); }),
                  log_end);
    net::co_spawn(*io_, keep_running("dashboards", *io_, pausing_, [this] { return beat(); }),
                  log_end);
    net::co_spawn(*io_, keep_running("uses", *io_, pausing_, [this] { return keep_uses(); }),
                  log_end);
    net::co_spawn(*io_,
                  keep_running("memory", *io_, pausing_, [this] { return give_memory_back(); }),
                  log_end);
    net::co_spawn(*io_, keep_running("clock", *io_, pausing_, [this] { return follow_clock(); }),
                  log_end);
    return {};
}

FleetRuntime::Ports Server::Impl::runtime_ports() {
    return {parts_.plant,
            parts_.store,
            *clock_,
            metrics_,
            [this](FleetRuntime::Job job) { net::post(*io_, std::move(job)); },
            [this](FleetRuntime::Published batch) {
                guarded("send", [&] { gateway_->send(batch.outputs.messages); });
                guarded("show", [&] { hub_->publish(batch); });
                guarded("plan", [&] { plan_legs(batch.outputs.plans_wanted); });
            },
            [this] {
                gateway_->introduce_all();
                hub_->resubscribe_all();
            }};
}

StreamHub::Ports Server::Impl::hub_ports() {
    return {[this](std::function<void(Result<events::Snapshot>)> done) {
                runtime_->read(&StreamHub::take, std::move(done));
            },
            [this](std::function<std::string()> write, std::function<void(Frame)> done) {
                const auto give = [this, done](Frame frame) {
                    net::post(*io_, [done, frame = std::move(frame)] { done(frame); });
                };
                const auto taken = encoders_->take("", [write = std::move(write), give](bool run) {
                    Frame frame;
                    if (run) {
                        guarded("snapshot",
                                [&] { frame = std::make_shared<const std::string>(write()); });
                    }
                    give(std::move(frame));
                });
                if (taken != Lane::Taken::kYes) give(nullptr);
            }};
}

/// A question that finds the lane full is asked again by the fleet.
void Server::Impl::plan_legs(const std::vector<fleet::LegPlanQuestion>& questions) {
    for (const auto& question : questions) {
        leg_plans_->take(question.vehicle.str(), [this, question](bool run) {
            if (!run) return;
            guarded("plan", [&] {
                runtime_->input(question.vehicle, [id = question.vehicle, number = question.number,
                                                   answer = answerer_.answer(question)](
                                                      fleet::Fleet& fleet, Time now) {
                    fleet.leg_planned(id, number, answer, now);
                });
            });
        });
    }
}

VehicleGateway::Ports Server::Impl::gateway_ports() {
    return {parts_.plant, options_.limits, *clock_, *runtime_,
            *access_,     metrics_,        images_, hub_->poses()};
}

net::awaitable<void> Server::Impl::beat() {
    net::steady_timer timer(*io_);
    for (;;) {
        timer.expires_after(StreamHub::kBeatPeriod);
        error_code ec;
        co_await timer.async_wait(into(ec));
        runtime_->listening();
        hub_->beat();
    }
}

/// Core time follows UTC; people hear of it when the two differ.
net::awaitable<void> Server::Impl::follow_clock() {
    net::steady_timer timer(*io_);
    while (!stopping_) {
        clock_->follow();
        const Duration ahead = clock_->ahead();
        if (const auto news = clock_watch_.look(ahead); news != ClockWatch::News::kNone) {
            tell_of_clock(news == ClockWatch::News::kDiffers, ahead);
        }
        metrics_.clock_ahead_ms = ahead / std::chrono::milliseconds(1);
        timer.expires_after(kFollowClock);
        error_code ec;
        co_await timer.async_wait(into(ec));
    }
}

/// In the log and in the events; while nothing can be stored, a second later again.
void Server::Impl::tell_of_clock(bool differs, Duration ahead) {
    const auto tell = [differs, ahead](fleet::Fleet& fleet, Time now) {
        if (differs) {
            fleet.clock_differs(ahead, now);
        } else {
            fleet.clock_agrees(now);
        }
        return true;
    };
    runtime_->command(tell, [this, differs, ahead](const Result<bool>& told) {
        if (!told) return clock_watch_.not_told();
        log::warn(differs ? "clock_differs" : "clock_agrees",
                  {{"ahead_s", std::to_string(std::llround(seconds(ahead)))},
                   {"remedy", differs && ahead > ServerClock::kTolerated
                                  ? "set the machine's clock; if that is right, restart the "
                                    "server: it then starts at UTC"
                                  : ""}});
    });
}

/// When sessions were used, written down now and then; those that have ended are dropped.
net::awaitable<void> Server::Impl::keep_uses() {
    net::steady_timer timer(*io_);
    while (!stopping_) {
        timer.expires_after(kKeepUses);
        error_code ec;
        co_await timer.async_wait(into(ec));
        const std::function<bool()> save = [this] {
            access_->save_uses();
            access_->forget_ended(clock_->now());
            return true;
        };
        co_await on<bool>(context_->workers, *io_, save, "uses of sessions");
    }
}

/// What a burst took stays with the process otherwise, and each takes a little more. It costs a
/// millisecond (a thousand vehicles, 190 MB).
net::awaitable<void> Server::Impl::give_memory_back() {
    net::steady_timer timer(*io_);
    while (!stopping_) {
        timer.expires_after(kGiveBack);
        error_code ec;
        co_await timer.async_wait(into(ec));
        const std::function<bool()> give_back = [] { return malloc_trim(0) != 0; };
        co_await on<bool>(context_->workers, *io_, give_back, "memory");
    }
}

void Server::Impl::run() {
    for (;;) {
        try {
            io_->run();
            return;
        } catch (const std::exception& e) {
            // One broken handler may not end the service.
            log::error("handler_threw", {{"what", e.what()}});
        }
    }
}

/// Nothing here may wait: who watches the server is answered until its end.
void Server::Impl::begin_stop() {
    if (std::exchange(stopping_, true)) return;
    log::info("stopping");
    context_->stops.stop_all();
    for (auto& lane : lanes_) lane->stop();
    stopper_ = std::thread([this] {
        crash_point(CrashPoint::kStopBeforeLastCommit);
        runtime_->stop();  // what was asked before is committed; its answers wait in io_
        crash_point(CrashPoint::kStopAfterLastCommit);
        net::post(*io_, [this] { net::co_spawn(*io_, finish(), log_end); });
    });
}

void Server::Impl::limit_stop() {
    stop_limit_.begin(kLongestStop, [this] {
        const auto queues = runtime_->queues();
        log::error("stop_unfinished", {{"commits", std::to_string(queues.commits)},
                                       {"commands", std::to_string(queues.commands)}});
        log::flush();
        std::_Exit(1);
    });
}

net::awaitable<void> Server::Impl::finish() {
    error_code ec;
    acceptor_->close(ec);
    const auto until = std::chrono::steady_clock::now() + kStopGrace;
    net::steady_timer timer(*io_);
    while (context_->connections > 0 && std::chrono::steady_clock::now() < until) {
        timer.expires_after(std::chrono::milliseconds(10));
        co_await timer.async_wait(into(ec));
    }
    io_->stop();
}

std::optional<Error> Server::Impl::not_ready() const {
    if (stopping_) {
        return Error{Errc::kUnavailable, {"stopping", {}}, "The server is stopping.", {}};
    }
    if (pausing_ > 0) {
        return Error{Errc::kUnavailable,
                     {"internal", {}},
                     "A part of the server met a fault of its own and is being started again.",
                     {}};
    }
    if (!runtime_->writable()) {
        return store_unavailable(runtime_->store_fault());
    }
    return std::nullopt;
}

std::string Server::Impl::metrics() const {
    return metrics_.text(hub_->orders_by_state(), hub_->vehicles_by_link(), runtime_->queues());
}

Server::Server(Options options, Parts parts)
    : impl_(std::make_unique<Impl>(std::move(options), parts)) {}
Server::~Server() = default;

Status Server::check(const Options& options) {
    const auto address = parse_address(options.listen);
    return address ? check_exposure(options, *address) : fail(address.error());
}
Status Server::start() { return impl_->start(); }
void Server::run() { impl_->run(); }
void Server::stop() {
    net::post(*impl_->io_, [impl = impl_.get()] { impl->begin_stop(); });
}
void Server::stop_on_signals() {
    impl_->signals_->add(SIGINT);
    impl_->signals_->add(SIGTERM);
    impl_->signals_->async_wait([impl = impl_.get()](const error_code& ec, int) {
        if (ec) return;
        error_code ignored;
        impl->signals_->clear(ignored);  // a second one ends the process as it ends any
        impl->limit_stop();
        impl->begin_stop();
    });
}
std::string Server::url() const {
    return (impl_->tls_ ? "https://" : "http://") + impl_->address_.text();
}
std::uint16_t Server::port() const { return impl_->address_.port; }
std::string Server::tls_fingerprint() const {
    return impl_->tls_ ? impl_->tls_->fingerprint : std::string();
}
access::AccessControl& Server::access() { return *impl_->access_; }

}  // namespace pulseline::server
