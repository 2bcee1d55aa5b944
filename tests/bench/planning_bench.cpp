// Planning: grid searches on benchmark maps (--maps DIR, else generated ones), the roadmap, and
// time per query of the leg planner on the final-assembly plant (or the plant file in
// PULSELINE_BENCH_PLANT). --only grids|roads|legs runs one part. The legs' figures go where
// --benchmark_out says, those of grids and roads beside it with -grids and -roads in the name.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <random>

#include "api/plant/plant_file.hpp"
#include "core/planning/grid/grid_search.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/planning/roads/roadmap_index.hpp"
#include "core/traffic/tiles.hpp"
#include "tests/bench/grid_bench.hpp"
#include "tests/bench/road_bench.hpp"

namespace pulseline::planning {
namespace {

plant::Plant plant_in(const char* path) {
    auto loaded = api::plant_file::load_plant_file(path);
    if (!loaded) {
        std::cerr << loaded.error().what << '\n';
        std::exit(2);
    }
    return std::move(*loaded);
}

const plant::Plant& bench_plant() {
    static const plant::Plant plant = [] {
        const char* path = std::getenv("PULSELINE_BENCH_PLANT");
        return plant_in(path ? path : PULSELINE_DEFAULT_PLANT);
    }();
    return plant;
}

/// Times every query by itself; the quantiles go into the counters, in microseconds. Of `repeats`
/// the least counts: on a shared machine the others tell of its other work.
template <class Query>
void measure(benchmark::State& state, Query query, int repeats = 1) {
    using Timer = std::chrono::steady_clock;
    std::vector<double> times_us;
    for (auto _ : state) {
        double least_us = std::numeric_limits<double>::infinity();
        for (int i = 0; i < repeats; ++i) {
            const auto begin = Timer::now();
            query();
            const std::chrono::duration<double, std::micro> time = Timer::now() - begin;
            least_us = std::min(least_us, time.count());
        }
        state.SetIterationTime(least_us * 1e-6);
        times_us.push_back(least_us);
    }
    std::sort(times_us.begin(), times_us.end());
    double sum = 0;
    for (const double t : times_us) sum += t;
    state.counters["mean_us"] = sum / static_cast<double>(times_us.size());
    state.counters["p50_us"] = times_us[times_us.size() / 2];
    state.counters["p99_us"] = times_us[times_us.size() * 99 / 100];
}

std::vector<LegRequest> requests() {
    const plant::Plant& plant = bench_plant();
    std::vector<LegRequest> result;
    for (const auto& type : plant.vehicle_types) {
        const auto may_stop = [&](const plant::Station& station) {
            const auto& types = station.vehicle_types;
            return types.empty() || std::find(types.begin(), types.end(), type.id) != types.end();
        };
        for (const auto& from : plant.stations) {
            for (const auto& to : plant.stations) {
                if (&from == &to || from.hall != to.hall || !may_stop(from) || !may_stop(to)) {
                    continue;
                }
                LegRequest request;
                request.type = &type;
                request.loaded = !type.load_footprint.empty();
                request.hall = from.hall;
                request.start = from.pose;
                request.from_station = from.id;
                request.target = to.id;
                result.push_back(request);
            }
        }
    }
    std::shuffle(result.begin(), result.end(), std::mt19937(1));
    return result;
}

void build(benchmark::State& state) {
    measure(state, [] { LegPlanner planner(bench_plant()); });
}

void assess_modes(benchmark::State& state) {
    const LegPlanner planner(bench_plant());
    const auto all = requests();
    std::size_t i = 0;
    measure(state,
            [&] { benchmark::DoNotOptimize(planner.assess_modes(all[i++ % all.size()], {})); });
}

void plan_leg(benchmark::State& state) {
    const LegPlanner planner(bench_plant());
    const auto all = requests();
    std::size_t i = 0;
    measure(state, [&] { benchmark::DoNotOptimize(planner.plan_leg(all[i++ % all.size()])); });
}

void roadmap(benchmark::State& state) {
    const RoadmapIndex roads(bench_plant());
    const auto passage = roads.passage(bench_plant().vehicle_types.back(), false);
    std::mt19937 random(2);
    const auto node = [&] { return static_cast<int>(random() % roads.graph().nodes.size()); };
    const auto usable = [&](int arc) { return roads.usable(passage, arc); };
    measure(state, [&] {
        benchmark::DoNotOptimize(
            find_path(roads.graph(), bench_plant().routing, node(), node(), std::nullopt, usable));
    });
}

void grid(benchmark::State& state) {
    const auto& hall = bench_plant().halls.front();
    const auto& type = bench_plant().vehicle_types.back();
    const FootprintLayers footprint(hall.grid, plant::outline_with_load(type, false),
                                    type.clearance_m);
    const GridMap map(footprint.layers());
    const auto cost = *hall_cost(bench_plant().routing, hall.grid.resolution_m);
    std::vector<Cell> free;
    for (int row = 0; row < map.height(); row += 7) {
        for (int col = 0; col < map.width(); col += 7) {
            if (!map.layers().no_turn.test({col, row})) free.push_back({col, row});
        }
    }
    if (free.empty()) return state.SkipWithError("no free cell");
    std::mt19937 random(3);
    const auto cell = [&] { return free[random() % free.size()]; };
    GridSearch search;
    GridRoute route;
    measure(state, [&] {
        benchmark::DoNotOptimize(
            search.run(map, {cell(), cell(), std::nullopt, cost}, Algorithm::kTurnJump, route));
    });
}

/// A measuring vehicle's drives between places of the hall that no straight joins.
std::vector<LegRequest> floor_requests(const plant::Plant& plant, const LegPlanner& planner) {
    constexpr std::size_t kRequests = 300;
    const auto& hall = plant.halls.front();
    const auto box = geometry::bounding_box(hall.outline);
    std::mt19937 random(4);
    const auto place = [&] {
        const auto share = [&] { return static_cast<double>(random() % 10'000) / 10'000; };
        return geometry::Pose2{box.min.x_m + share() * (box.max.x_m - box.min.x_m),
                               box.min.y_m + share() * (box.max.y_m - box.min.y_m),
                               2 * kPi * share()};
    };
    std::vector<LegRequest> requests;
    for (int tries = 0; tries < 20'000 && requests.size() < kRequests; ++tries) {
        LegRequest request;
        request.type = plant::find_vehicle_type(plant, plant::VehicleTypeId("measuring-vehicle"));
        request.hall = hall.id;
        request.start = place();
        request.target_pose = place();
        request.mode = plant::MotionMode::kLinear;
        const auto leg = planner.plan_leg(request);
        if (!leg) continue;
        const auto straights = std::ranges::count(
            leg->segments, kinematics::Segment::Kind::kStraight, &kinematics::Segment::kind);
        if (straights > 1) requests.push_back(request);
    }
    return requests;
}

void floor_leg(benchmark::State& state, const char* path) {
    const plant::Plant plant = plant_in(path);
    const LegPlanner planner(plant);
    const auto all = floor_requests(plant, planner);
    if (all.empty()) return state.SkipWithError("no such drive");
    constexpr std::size_t kRepeats = 5;
    std::size_t i = 0;
    measure(
        state,
        [&] { benchmark::DoNotOptimize(planner.plan_leg(all[i++ / kRepeats % all.size()])); },
        kRepeats);
    state.counters["drives"] = static_cast<double>(all.size());
}

/// The first leg over a hall's floor looks at all of its cells.
void first_floor_leg(benchmark::State& state) {
    const plant::Plant plant = plant_in(PULSELINE_DEFAULT_PLANT);
    const LegPlanner warm(plant);
    const auto all = floor_requests(plant, warm);
    if (all.empty()) return state.SkipWithError("no such drive");
    std::vector<LegPlanner> fresh;
    for (int i = 0; i < 5; ++i) fresh.emplace_back(plant);
    std::size_t i = 0;
    measure(state, [&] { benchmark::DoNotOptimize(fresh[i++].plan_leg(all.front())); });
}

void tiles_of_a_30_m_arc(benchmark::State& state) {
    plant::VehicleType type;
    type.motion_modes = {plant::MotionMode::kFixedAxisRotation};
    const auto plan = kinematics::plan_motion(type, {0, 0, 0}, {19.1, 19.1, kPi / 2},
                                              plant::MotionMode::kFixedAxisRotation);
    const auto pieces = kinematics::sweep({geometry::rectangle(10.5, 2.5)}, plan->segments);
    measure(state, [&] { benchmark::DoNotOptimize(traffic::tiles_under(0, pieces, 0.1)); });
}

BENCHMARK(build)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(10);
BENCHMARK(assess_modes)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(400);
BENCHMARK(plan_leg)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(400);
BENCHMARK(roadmap)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(5000);
BENCHMARK(grid)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(60);
BENCHMARK_CAPTURE(floor_leg, final_assembly, PULSELINE_DEFAULT_PLANT)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(300);
BENCHMARK_CAPTURE(floor_leg, measuring_hall, PULSELINE_MEASURING_HALL)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(300);
BENCHMARK(first_floor_leg)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5);
BENCHMARK(tiles_of_a_30_m_arc)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(500);

}  // namespace
}  // namespace pulseline::planning

namespace {

/// Takes `--name VALUE` out of the arguments.
std::string take(std::vector<char*>& arguments, const std::string& name) {
    for (std::size_t i = 1; i + 1 < arguments.size(); ++i) {
        if (arguments[i] != name) continue;
        const std::string value = arguments[i + 1];
        arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i),
                        arguments.begin() + static_cast<std::ptrdiff_t>(i) + 2);
        return value;
    }
    return {};
}

void write(const std::string& out, const std::string& part, const nlohmann::json& figures) {
    if (out.empty()) return;
    const std::size_t end = out.rfind(".json");
    std::ofstream(out.substr(0, end) + "-" + part + ".json") << figures.dump(2) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    const std::string maps = take(arguments, "--maps");
    const std::string only = take(arguments, "--only");
    std::string out;
    for (const char* argument : arguments) {
        const std::string_view prefix = "--benchmark_out=";
        if (std::string_view(argument).starts_with(prefix)) out = argument + prefix.size();
    }
    if (only.empty() || only == "grids") {
        write(out, "grids", pulseline::bench::bench_grids(maps));
    }
    if (only.empty() || only == "roads") write(out, "roads", pulseline::bench::bench_roads());
    if (!only.empty() && only != "legs") return 0;
    argc = static_cast<int>(arguments.size());
    benchmark::Initialize(&argc, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(argc, arguments.data())) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
