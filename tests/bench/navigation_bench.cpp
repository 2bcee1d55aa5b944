// ./dev bench navigation: what it costs a vehicle to know where it is.
#include <benchmark/benchmark.h>

#include <cmath>
#include <stdexcept>

#include "api/plant/plant_file.hpp"
#include "core/localisation/igps_pose.hpp"
#include "core/localisation/pose_filter.hpp"
#include "core/localisation/reflector_pose.hpp"
#include "core/mapping/monte_carlo.hpp"
#include "core/simulation/world/scanners.hpp"

namespace {

using namespace pulseline;

/// The iGPS cell, its vehicle at station 3, and what its receivers see there.
struct Cell {
    Cell() {
        auto loaded = api::plant_file::load_plant_file(PULSELINE_PLANTS "/igps-cell.json");
        if (!loaded) throw std::runtime_error(loaded.error().what);
        plant = std::move(*loaded);
        type = *plant::find_vehicle_type(plant, plant.vehicles.front().type);
        const geometry::Pose2 pose{26, 12.5, 0.3};
        for (const auto& receiver : type.receivers) {
            const auto at = pose * receiver.position;
            const Eigen::Vector3d place(at.x_m, at.y_m, receiver.z_m);
            localisation::ReceiverLight seen{receiver.name, {}};
            for (const auto& from :
                 localisation::transmitters_in_view(plant, plant.halls.front().id, place)) {
                seen.light.push_back(*localisation::light_on(from, place));
            }
            light.push_back(std::move(seen));
        }
    }
    plant::Plant plant;
    plant::VehicleType type;
    std::vector<localisation::ReceiverLight> light;
};

const Cell& cell() {
    static const Cell kCell;
    return kCell;
}

localisation::PoseFilter filter() {
    Eigen::Matrix3d known = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
    return {{26, 12.5, 0.3}, known, localisation::odometry_noise({}, cell().type)};
}

void filter_step(benchmark::State& state) {
    auto knows = filter();
    for (auto _ : state) {
        knows.drive({0.01, 0.001, 1e-4});
        benchmark::DoNotOptimize(knows.pose());
    }
}
BENCHMARK(filter_step);

void filter_correction(benchmark::State& state) {
    const auto fix = localisation::locate_by_light(cell().light, cell().plant.transmitters,
                                                   cell().type.receivers)
                         .value();
    auto knows = filter();
    for (auto _ : state) {
        benchmark::DoNotOptimize(knows.correct(fix.fix));
    }
}
BENCHMARK(filter_correction);

/// A whole fix of four receivers: 50 us at most.
void igps_fix(benchmark::State& state) {
    for (auto _ : state) {
        auto fix = localisation::locate_by_light(cell().light, cell().plant.transmitters,
                                                 cell().type.receivers);
        benchmark::DoNotOptimize(fix);
    }
    std::size_t beams = 0;
    for (const auto& seen : cell().light) beams += seen.light.size();
    state.counters["beams"] = static_cast<double>(beams);
}
BENCHMARK(igps_fix);

/// The measuring hall, and what a navigation scanner sees of its reflectors from the middle.
struct Hall {
    Hall() {
        auto loaded = api::plant_file::load_plant_file(PULSELINE_PLANTS "/measuring-hall.json");
        if (!loaded) throw std::runtime_error(loaded.error().what);
        plant = std::move(*loaded);
        scanner = *plant.vehicle_types.front().navigation_scanner;
        const auto scanner_from_hall = inverse(pose * scanner.body_from_scanner);
        for (const auto& one :
             localisation::reflectors_in_view(plant, plant.halls.front().id, scanner, pose)) {
            const auto at = scanner_from_hall * one.position;
            const localisation::ReflectorSight sight{std::atan2(at.y_m, at.x_m),
                                                     std::hypot(at.x_m, at.y_m), 5e-4, 0.005};
            seen.push_back(localisation::seen_reflector(sight, scanner));
        }
    }
    const geometry::Pose2 pose{22, 14.5, 0.3};
    plant::Plant plant;
    plant::NavigationScanner scanner;
    std::vector<localisation::SeenReflector> seen;
};

const Hall& hall() {
    static const Hall kHall;
    return kHall;
}

/// One turn of the scanner near a believed pose.
void reflector_fix(benchmark::State& state) {
    const Eigen::Vector3d variance(1e-4, 1e-4, 1e-5);
    for (auto _ : state) {
        auto fix =
            localisation::locate_by_reflectors(hall().seen, hall().plant.reflectors, hall().scanner,
                                               {hall().pose, variance.asDiagonal()});
        if (!fix) throw std::runtime_error(fix.error().what);
        benchmark::DoNotOptimize(fix);
    }
    state.counters["reflectors"] = static_cast<double>(hall().seen.size());
}
BENCHMARK(reflector_fix);

/// Once, by a vehicle that knows nothing.
void reflectors_found(benchmark::State& state) {
    for (auto _ : state) {
        auto fix =
            localisation::find_by_reflectors(hall().seen, hall().plant.reflectors, hall().scanner);
        if (!fix) throw std::runtime_error(fix.error().what);
        benchmark::DoNotOptimize(fix);
    }
}
BENCHMARK(reflectors_found);

/// The same among 200 reflectors at equal distances, where it has to give up.
void reflectors_alike(benchmark::State& state) {
    std::vector<plant::Reflector> grid;
    for (int i = 0; i < 200; ++i) {
        plant::Reflector one;
        one.position = {5.0 * (i % 20), 5.0 * (i / 20)};
        grid.push_back(one);
    }
    std::vector<localisation::SeenReflector> seen;
    for (int i = 0; i < 12; ++i) {
        seen.push_back(
            {{5.0 * (i % 4) - 6, 5.0 * (i / 4) - 6}, 0.01 * Eigen::Matrix2d::Identity()});
    }
    for (auto _ : state) {
        auto fix = localisation::find_by_reflectors(seen, grid, hall().scanner);
        if (fix) throw std::runtime_error("found among places that look alike");
        benchmark::DoNotOptimize(fix);
    }
}
BENCHMARK(reflectors_alike);

/// A look at the walls of the measuring hall in its map: 10 ms at most, where the vehicle knows its
/// place (0) and where a person has told it (1).
void contours_look(benchmark::State& state) {
    const bool told = state.range(0) == 1;
    const auto plant = api::plant_file::load_plant_file(PULSELINE_PLANTS "/measuring-hall.json");
    auto map = mapping::read_map(PULSELINE_PLANTS "/../maps/measuring-hall/hall.yaml");
    if (!plant || !map) throw std::runtime_error("no plant, or no map of it");
    const auto world = simulation::make_world(*plant, 1);
    const geometry::Pose2 pose = plant->stations[1].pose;
    simulation::SimulatedScanners scanners(world, plant->halls.front().id,
                                           plant->vehicle_types.front(), pose, 1);
    std::vector<control::Scan> scans;
    scanners.scan(scans);
    mapping::MonteCarlo particles(mapping::prepare(std::move(*map)), 1);
    const double sigma_m = told ? 0.05 : 0.02;
    const double sigma_rad = told ? 0.04 : 0.01;
    const Eigen::Vector3d variance(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad);
    for (auto _ : state) {
        auto look = particles.look(pose, variance.asDiagonal(), Eigen::Matrix3d::Zero(),
                                   Eigen::Matrix3d::Zero(), scans);
        benchmark::DoNotOptimize(look);
        state.counters["explained"] = look.explained;
    }
}
BENCHMARK(contours_look)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
