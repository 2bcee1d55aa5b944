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

double sideways_mm(const Stop& stop) {
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

/// What each paper has, and what is asked of us.
bool keeps(const std::string& vehicle, const std::vector<Stop>& stops) {
    if (vehicle == "TP-01") {
        return most(stops, sideways_mm) <= 10 && most(stops, turned_deg) <= 0.15 &&
               mean(stops, away_mm) < 1;
    }
    if (vehicle == "OM-01") return most(stops, sideways_mm) <= 0.5;
    return mean(stops, away_mm) <= 0.758 && mean(stops, turned_deg) <= 0.239;
}

const char* asked(const std::string& vehicle) {
    if (vehicle == "TP-01") return "Tang: +-10 mm, +-0.15 deg always, mean < 1 mm";
    if (vehicle == "OM-01") return "Wang: +-0.5 mm always";
    return "Li 2020: ten times better than 7.58 mm, 2.39 deg";
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
                          keeps(family.vehicle, made);
        good &= kept;
        fmt::print(
            "{:<24}{:>9.2f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.4f}{:>9.4f}{:>7.2f}{:>8.1f}  {}: {}\n",
            family.name, mean(made, arrived_mm), mean(made, away_mm), most(made, sideways_mm),
            most(made, away_mm), mean(made, turned_deg), most(made, turned_deg),
            mean(made, [](const Stop& stop) { return double(stop.looks); }),
            mean(made, [](const Stop& stop) { return stop.time_s; }), asked(family.vehicle),
            kept ? "yes" : "NO");
        if (!made.back().why_not.empty()) {
            fmt::print("  refused at station {}: {}\n", made.back().station, made.back().why_not);
        }
        std::fflush(stdout);
    }
    return good;
}

}  // namespace pulseline::experiments
