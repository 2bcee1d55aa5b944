// pulseline-agent: simulated vehicles that obey a Pulseline server over the vehicle link.

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/plant/plant_file.hpp"
#include "core/mapping/monte_carlo.hpp"
#include "server/agent/hand_held_link.hpp"
#include "server/agent/link_client.hpp"
#include "server/agent/machine_command.hpp"
#include "server/agent/map_command.hpp"
#include "server/agent/options.hpp"
#include "server/agent/simulated_vehicle.hpp"
#include "server/agent/tcp_vehicle.hpp"
#include "server/agent/truth_log.hpp"
#include "server/base/log.hpp"
#include "server/base/net.hpp"

namespace pulseline::agent {
namespace {

namespace net = server::net;
using namespace std::chrono_literals;

constexpr int kExitTrouble = 1;
constexpr int kExitReplaced = 3;
constexpr auto kTick = 20ms;
constexpr double kLongestStep_s = 0.2;  // after a stall the vehicle must not leap
constexpr auto kTellLostTime = 1s;

struct Unit {
    std::unique_ptr<RunningVehicle> vehicle;
    SimulatedMachine* machine = nullptr;  // of a simulated one
    std::unique_ptr<LinkClient> link;
};

/// Maps of the halls, each read once.
class HallMaps {
public:
    explicit HallMaps(std::string folder) : folder_(std::move(folder)) {}

    /// Nothing: there is none of that hall. Errors: as mapping::read_map.
    Result<std::shared_ptr<const mapping::MatchedMap>> of(const plant::HallId& hall) {
        if (folder_.empty()) return nullptr;
        const auto known = maps_.find(hall);
        if (known != maps_.end()) return known->second;
        const auto file = std::filesystem::path(folder_) / (hall.str() + ".yaml");
        if (!std::filesystem::exists(file)) {
            server::log::warn("map.none", {{"file", file.string()}});
            return maps_[hall] = nullptr;
        }
        auto map = mapping::read_map(file);
        if (!map) return fail(map.error());
        return maps_[hall] = mapping::prepare(std::move(*map));
    }

private:
    std::string folder_;
    std::map<plant::HallId, std::shared_ptr<const mapping::MatchedMap>> maps_;
};

/// Where the vehicle truly stands: where its log left it, else placed at home.
Result<geometry::Pose2> start_pose(const Options& options, const simulation::World& world,
                                   const plant::Vehicle& vehicle) {
    if (!options.truth_log.empty()) {
        if (const auto last = last_true_pose(options.truth_log, vehicle.id.str())) return *last;
    }
    return simulation::placed_pose(world, vehicle, options.seed);
}

/// Its machine is behind a controller.
Result<Unit> make_tcp_vehicle(const Options& options, const simulation::World& world,
                              const plant::Vehicle& vehicle,
                              std::shared_ptr<const mapping::MatchedMap> map, BeliefLog* belief) {
    const auto address = parse_machine(options.machine);
    if (!address) return fail(address.error());
    VehicleSettings known;
    known.hall = plant::find_station(world.plant, vehicle.home)->hall;
    known.learned = options.learned;
    known.map = std::move(map);
    known.particles_seed = simulation::seed_for(options.seed, "particles " + vehicle.id.str());
    TcpMachine::Settings settings;
    settings.time_factor = options.time_factor;
    settings.errors = world.errors;
    settings.watchdog_s = options.machine_watchdog_s;
    auto opened = TcpVehicle::open(*address, world.plant, vehicle, std::move(settings),
                                   options.cameras, std::move(known), belief);
    if (!opened) return fail(opened.error());
    return Unit{std::move(*opened), nullptr, nullptr};
}

Result<Unit> make_vehicle(const Options& options, const simulation::World& world,
                          const Identity& identity, HallMaps& maps, TruthLog* truth,
                          BeliefLog* belief) {
    const auto* vehicle =
        plant::find_vehicle(world.plant, identity.manufacturer, identity.serial_number);
    if (vehicle == nullptr) {
        return fail(Errc::kNotFound, "unknown_vehicle",
                    "the plant " + options.world_file + " has no vehicle " + identity.manufacturer +
                        "/" + identity.serial_number);
    }
    if (plant::find_station(world.plant, vehicle->home) == nullptr ||
        plant::find_vehicle_type(world.plant, vehicle->type) == nullptr) {
        return fail(Errc::kNotFound, "incomplete_vehicle",
                    "vehicle " + vehicle->id.str() + " lacks its home station or its type");
    }
    const auto pose = start_pose(options, world, *vehicle);
    if (!pose) return fail(pose.error());
    auto map = maps.of(plant::find_station(world.plant, vehicle->home)->hall);
    if (!map) return fail(map.error());
    if (!options.machine.empty())
        return make_tcp_vehicle(options, world, *vehicle, std::move(*map), belief);
    SimulationSettings settings;
    settings.seed = options.seed;
    settings.time_factor = options.time_factor;
    settings.battery_percent = options.battery_percent;
    settings.rendered = options.rendered;
    settings.servo_drive = options.servo_drive;
    settings.faults = options.faults;
    SimulatedVehicle::Program program;
    program.vehicles = static_cast<int>(options.vehicles.size());
    program.learned = options.learned;
    program.map = std::move(*map);
    auto made = std::make_unique<SimulatedVehicle>(world, *vehicle, *pose, std::move(settings),
                                                   std::move(program), truth);
    SimulatedMachine* machine = &made->machine();
    return Unit{std::move(made), machine, nullptr};
}

/// Vehicles of one process stand in one hall and see each other; those of another process do not.
void let_see(const std::vector<Unit>& units) {
    for (const auto& unit : units) {
        SimulatedMachine* own = unit.machine;
        if (own == nullptr) continue;
        own->see([&units, own](geometry::Point2 from, std::vector<geometry::Polygon>& seen) {
            for (const auto& other : units) {
                if (other.machine != nullptr && other.machine != own)
                    other.machine->show_body(own->hall(), from, seen);
            }
        });
    }
}

/// Of the set points of a machine over TCP; there is one vehicle only then.
double cycle_s(std::vector<Unit>& units) {
    return units.front().vehicle->program().type().control.cycle_s;
}

net::awaitable<void> step_all(std::vector<Unit>& units, Vehicle::Steady::duration tick,
                              const bool& running) {
    net::steady_timer timer(co_await net::this_coro::executor);
    auto last = Vehicle::Steady::now();
    auto told = last - kTellLostTime;
    double lost_s = 0;
    while (running) {
        const auto now = Vehicle::Steady::now();
        const double passed_s = std::chrono::duration<double>(now - last).count();
        const double dt_s = std::min(kLongestStep_s, passed_s);
        last = now;
        lost_s += passed_s - dt_s;
        if (lost_s > 0 && now - told >= kTellLostTime) {
            server::log::warn("time.lost", {{"seconds", std::to_string(lost_s)}});
            told = now;
            lost_s = 0;
        }
        for (auto& unit : units) unit.vehicle->step(dt_s, now);
        timer.expires_after(tick);
        server::error_code ec;
        co_await timer.async_wait(server::into(ec));
    }
}

Status set_up_tls(server::ssl::context& tls, const Options& options) {
    server::error_code ec;
    if (options.insecure) {
        tls.set_verify_mode(server::ssl::verify_none, ec);
        return {};
    }
    tls.set_verify_mode(server::ssl::verify_peer, ec);
    if (options.ca_file.empty()) {
        tls.set_default_verify_paths(ec);
    } else {
        tls.load_verify_file(options.ca_file, ec);
    }
    if (!ec) return {};
    return fail(Errc::kInvalid, "bad_ca",
                "cannot use --ca " + options.ca_file + ": " + ec.message());
}

Result<int> run(const Options& options) {
    auto plant = api::plant_file::load_plant_file(options.world_file);
    if (!plant) return fail(plant.error());
    const auto world = simulation::make_world(std::move(*plant), options.seed,
                                              localisation::ErrorBudget::named(options.errors));
    std::optional<TruthLog> truth;
    server::ssl::context tls(server::ssl::context::tls_client);
    if (const auto status = set_up_tls(tls, options); !status) return fail(status.error());

    net::io_context io(1);
    std::vector<Unit> units;
    HallMaps maps(options.maps);
    if (!options.truth_log.empty()) {
        auto log = TruthLog::open(options.truth_log);
        if (!log) return fail(log.error());
        truth.emplace(std::move(*log));
    }
    std::optional<BeliefLog> belief;
    if (!options.belief_log.empty()) {
        auto log = BeliefLog::open(options.belief_log);
        if (!log) return fail(log.error());
        belief.emplace(std::move(*log));
    }
    for (const auto& identity : options.vehicles) {
        auto unit = make_vehicle(options, world, identity, maps, truth ? &*truth : nullptr,
                                 belief ? &*belief : nullptr);
        if (!unit) return fail(unit.error());
        unit->link = std::make_unique<LinkClient>(
            io, tls, options.server, identity, !options.insecure, unit->vehicle->program(),
            simulation::seed_for(options.seed, "link " + identity.serial_number));
        units.push_back(std::move(*unit));
    }

    let_see(units);

    std::unique_ptr<HandHeldLink> hand_held;
    if (!options.hand_held.empty()) {
        std::vector<Vehicle*> vehicles;
        for (const auto& unit : units) vehicles.push_back(&unit.vehicle->program());
        auto opened = HandHeldLink::open(io, options.hand_held, std::move(vehicles));
        if (!opened) return fail(opened.error());
        hand_held = std::move(*opened);
        net::co_spawn(io, hand_held->run(), [](const std::exception_ptr& error) {
            if (error) std::rethrow_exception(error);
        });
    }

    bool running = true;
    std::size_t alive = units.size();
    net::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&](const server::error_code& ec, int) {
        if (ec) return;
        for (auto& unit : units) unit.link->stop();
    });
    for (auto& unit : units) {
        net::co_spawn(io, unit.link->run(), [&](const std::exception_ptr& error) {
            if (error) std::rethrow_exception(error);
            if (--alive > 0) return;
            running = false;
            signals.cancel();
            if (hand_held) hand_held->stop();
        });
    }
    // A machine over TCP is sent its set points in its own cycle.
    const auto tick = options.machine.empty()
                          ? kTick
                          : std::chrono::duration_cast<Vehicle::Steady::duration>(
                                std::chrono::duration<double>(cycle_s(units)));
    net::co_spawn(io, step_all(units, tick, running), [](const std::exception_ptr& error) {
        if (error) std::rethrow_exception(error);
    });
    io.run();
    const bool replaced = std::any_of(units.begin(), units.end(),
                                      [](const Unit& unit) { return unit.link->replaced(); });
    return replaced ? kExitReplaced : 0;
}

}  // namespace
}  // namespace pulseline::agent

int main(int argc, char** argv) {
    using namespace pulseline;
    cv::setNumThreads(1);  // many agents share one machine
    if (argc > 1 && std::string_view(argv[1]) == "map")
        return agent::map_command(argc - 1, argv + 1);
    if (argc > 1 && std::string_view(argv[1]) == "machine")
        return agent::machine_command(argc - 1, argv + 1);
    int exit_code = 0;
    const auto options = agent::read_options(argc, argv, exit_code);
    if (!options) return exit_code;
    try {
        const auto ended = agent::run(*options);
        if (ended) return *ended;
        server::log::error("agent.ended", {{"what", ended.error().what}});
    } catch (const std::exception& error) {
        server::log::error("agent.ended", {{"what", error.what()}});
    }
    return agent::kExitTrouble;
}
