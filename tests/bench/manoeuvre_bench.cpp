#include "tests/bench/manoeuvre_bench.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/planning/manoeuvre/free_manoeuvre.hpp"
#include "tests/bench/manoeuvre_reference.hpp"

namespace pulseline::bench {
namespace {

using nlohmann::json;
using plant::MotionMode;

constexpr double kMedianLimit_ms = 50;
constexpr double kRatioLimit = 1.3;

// Of the processor: what others do on the machine does not count.
double now_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

struct Run {
    std::size_t queries = 0;
    std::size_t by_stage[3] = {0, 0, 0};  // FreeManoeuvre::Found
    std::vector<double> ms;
    std::vector<double> direct_ms;
    std::vector<double> lengths_m;  // 0: not solved
};

Run plan_all(const ManoeuvreScene& scene, const planning::FreeFloor& floor,
             const plant::VehicleType& type, const std::vector<ManoeuvreQuery>& queries) {
    Run run;
    run.queries = queries.size();
    for (const ManoeuvreQuery& query : queries) {
        planning::FreeManoeuvreRequest request;
        request.type = &type;
        request.start = query.start;
        request.goal = query.goal;
        request.standing = scene.parked;
        const double start = now_ms();
        const auto found = planning::plan_free_manoeuvre(floor, request);
        run.ms.push_back(now_ms() - start);
        run.lengths_m.push_back(found ? found->motion.length_m : 0);
        if (!found) continue;
        ++run.by_stage[static_cast<int>(found->found)];
        if (found->found == planning::FreeManoeuvre::Found::kDirectly) {
            run.direct_ms.push_back(run.ms.back());
        }
    }
    return run;
}

json time_json(const char* name, const Run& run) {
    const auto solved = static_cast<std::size_t>(
        std::count_if(run.lengths_m.begin(), run.lengths_m.end(), [](double m) { return m > 0; }));
    const double median = quantile(run.ms, 0.5);
    const double p90 = quantile(run.ms, 0.9);
    const double p99 = quantile(run.ms, 0.99);
    std::printf(
        "%-20s %3zu of %zu solved (%zu directly, %zu by lattice, %zu by sampling); ms median "
        "%.1f p90 %.1f p99 %.1f, directly %.2f\n",
        name, solved, run.queries, run.by_stage[0], run.by_stage[1], run.by_stage[2], median, p90,
        p99, quantile(run.direct_ms, 0.5));
    return {{"queries", run.queries},
            {"solved", solved},
            {"directly", run.by_stage[0]},
            {"by_lattice", run.by_stage[1]},
            {"by_sampling", run.by_stage[2]},
            {"median_ms", median},
            {"p90_ms", p90},
            {"p99_ms", p99},
            {"max_ms", quantile(run.ms, 1)},
            {"directly_median_ms", quantile(run.direct_ms, 0.5)}};
}

/// Length of each against the best known of RRT*, RRTConnect and this run itself.
json ratio_json(const Run& run, const std::vector<ManoeuvreQuery>& queries, double& worst) {
    std::vector<double> ratios;
    std::size_t shorter = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const double own_m = run.lengths_m[i];
        if (own_m <= 0) continue;
        const bool best = queries[i].best_m <= 0 || own_m < queries[i].best_m;
        shorter += best ? 1 : 0;
        ratios.push_back(best ? 1 : own_m / queries[i].best_m);
    }
    worst = quantile(ratios, 1);
    std::printf("%-20s median %.3f p90 %.3f max %.3f; shorter than the reference %zu times\n",
                "  length ratio", quantile(ratios, 0.5), quantile(ratios, 0.9), worst, shorter);
    return {{"median", quantile(ratios, 0.5)},
            {"p90", quantile(ratios, 0.9)},
            {"max", worst},
            {"shorter_than_reference", shorter}};
}

/// Mean time of the fast test over random places of the hall.
double test_ns(const planning::FreeFloor& floor) {
    constexpr int kPlaces = 200'000;
    const planning::FootprintCheck& check = floor.bodies.front().check;
    std::vector<geometry::Pose2> places;
    for (int i = 0; i < 1000; ++i) {
        places.push_back(
            {120 * std::fmod(i * 0.754877666, 1.0), 60 * std::fmod(i * 0.569840291, 1.0), i * 0.1});
    }
    int free = 0;
    const double start = now_ms();
    for (int i = 0; i < kPlaces; ++i) {
        free += check.is_free(floor.field, places[static_cast<std::size_t>(i % 1000)]) ? 1 : 0;
    }
    const double ns = 1e6 * (now_ms() - start) / kPlaces;
    return free > 0 ? ns : 0;
}

}  // namespace

json measure_manoeuvres(bool& passed) {
    const auto queries = read_reference(PULSELINE_MANOEUVRE_REFERENCE);
    const ManoeuvreScene scene;
    const double start = now_ms();
    const planning::FreeFloor floor(scene.plant, scene.hall());
    const double built_ms = now_ms() - start;
    const double ns = test_ns(floor);
    std::printf("free manoeuvres: %zu queries, floor built in %.0f ms, one test %.0f ns\n",
                queries.size(), built_ms, ns);

    const Run steered = plan_all(scene, floor, scene.platform(), queries);
    json result{{"floor_ms", built_ms}, {"test_ns", ns}};
    result["arcs_only"] = time_json("arcs only", steered);
    double worst = 0;
    result["arcs_only"]["length_ratio"] = ratio_json(steered, queries, worst);

    // As in db/plants: it may turn on the spot as well.
    plant::VehicleType turning = scene.platform();
    turning.motion_modes = {MotionMode::kSelfRotation, MotionMode::kLinear,
                            MotionMode::kFixedAxisRotation, MotionMode::kFree};
    const Run spot = plan_all(scene, floor, turning, queries);
    result["turning_on_the_spot"] = time_json("turning on the spot", spot);

    const auto solved = [](const Run& run) {
        return std::all_of(run.lengths_m.begin(), run.lengths_m.end(),
                           [](double m) { return m > 0; });
    };
    const bool kept = !queries.empty() && solved(steered) && solved(spot) &&
                      quantile(steered.ms, 0.5) <= kMedianLimit_ms && worst <= kRatioLimit;
    std::printf("  demanded: all solved, median <= %.0f ms, length ratio <= %.1f: %s\n",
                kMedianLimit_ms, kRatioLimit, kept ? "kept" : "MISSED");
    passed = passed && kept;
    return result;
}

}  // namespace pulseline::bench
