#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/experiments/experiments.hpp"
#include "tests/experiments/stop_runs.hpp"

namespace pulseline::experiments {
namespace {

constexpr int kStops = 200;
constexpr double kTimeFactor = 10;

double along_axis_mm(const Stop& stop) {
    return 1e3 * std::max(std::abs(stop.off.x_m), std::abs(stop.off.y_m));
}
double away_mm(const Stop& stop) { return 1e3 * norm(stop.off.position()); }
double turned_deg(const Stop& stop) { return degrees(std::abs(stop.off.heading_rad)); }
double arrived_mm(const Stop& stop) { return 1e3 * norm(stop.arrived.position()); }

double mean(const std::vector<Stop>& stops, const std::function<double(const Stop&)>& of) {
    double sum = 0;
    for (const Stop& stop : stops) sum += of(stop);
    return sum / static_cast<double>(stops.size());
}
double most(const std::vector<Stop>& stops, const std::function<double(const Stop&)>& of) {
    double most = 0;
    for (const Stop& stop : stops) most = std::max(most, of(stop));
    return most;
}

bool keeps(const StopDemand& demand, const std::vector<Stop>& stops) {
    return most(stops, along_axis_mm) <= demand.most_axis_mm &&
           most(stops, turned_deg) <= demand.most_deg && mean(stops, away_mm) <= demand.mean_mm &&
           mean(stops, turned_deg) <= demand.mean_deg;
}

}  // namespace

bool stops(const Options& options) {
    const int count = options.runs.value_or(kStops);
    fmt::print("\n{} stops a family, by the true pose against the drawing, mm and deg\n", count);
    fmt::print("{:<24}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}\n", "", "arrived", "mean",
               "axis max", "max", "deg mean", "deg max", "looks", "time s");
    bool good = true;
    for (const StopFamily& family : stop_families()) {
        const auto made = run_stops(family, options.folder + "/../../db/plants/final-assembly.json",
                                    count, options.seed, kTimeFactor);
        const bool kept = static_cast<int>(made.size()) == count && made.back().why_not.empty() &&
                          keeps(family.demand, made);
        good &= kept;
        fmt::print(
            "{:<24}{:>9.2f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.4f}{:>9.4f}{:>7.2f}{:>8.1f}  {}: {}\n",
            family.name, mean(made, arrived_mm), mean(made, away_mm), most(made, along_axis_mm),
            most(made, away_mm), mean(made, turned_deg), most(made, turned_deg),
            mean(made, [](const Stop& stop) { return double(stop.looks); }),
            mean(made, [](const Stop& stop) { return stop.time_s; }), family.demand.words,
            kept ? "yes" : "NO");
        if (!made.back().why_not.empty()) {
            fmt::print("  refused at station {}: {}\n", made.back().station, made.back().why_not);
        }
        std::fflush(stdout);
    }
    return good;
}

}  // namespace pulseline::experiments
