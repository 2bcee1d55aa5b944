#include <sodium.h>

#include "api/http/plant/documents.hpp"
#include "core/base/crash_point.hpp"
#include "server/base/keep_running.hpp"
#include "server/server_impl.hpp"
#include "server/sessions/listener.hpp"
#include "server/sessions/origins.hpp"

/// How the server is put together, in order.
namespace pulseline::server {
namespace {

constexpr int kStopsShown = 50;
constexpr int kNiceOfHeavy = 5;
constexpr int kNiceOfStrangers = 10;  // behind all else, but not starved on a busy machine

std::uint64_t random_seed() {
    std::uint64_t seed = 0;
    randombytes_buf(&seed, sizeof seed);
    return seed;
}

}  // namespace

Status Server::Impl::start() {
    if (auto open = listen(); !open) return open;
    crash_point(CrashPoint::kStartBeforeLoad);
    auto stored = parts_.store.load();
    make_parts(stored);
    make_context();
    if (auto started = runtime_->start(std::move(stored)); !started) return started;
    hub_->connect(hub_ports());
    hub_->resubscribe_all();
    begin_loops();
    return {};
}

/// Address, proxies, certificate, and the socket.
Status Server::Impl::listen() {
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
    return {};
}

void Server::Impl::make_parts(const fleet::StoredFleet& stored) {
    clock_.emplace(stored.last_time);
    documents_ = api::make_documents(parts_.plant);
    hub_.emplace(parts_.plant, images_, *clock_, metrics_);
    fleet::StopQuery newest;
    newest.limit = kStopsShown;
    hub_->start(parts_.history.stops(newest), stored.last_event_seq);
    runtime_.emplace(runtime_ports(), random_seed());
    access_.emplace(
        parts_.access,
        [this](const api::access::Change& change) {
            runtime_->write([this, change] { api::access::apply(parts_.access, change); });
        },
        clock_->now(), stored.last_time);
    gateway_.emplace(gateway_ports());
    history_.emplace(parts_.history);
}

/// The lanes of work, and what every session is given.
void Server::Impl::make_context() {
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
}

void Server::Impl::begin_loops() {
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

}  // namespace pulseline::server
