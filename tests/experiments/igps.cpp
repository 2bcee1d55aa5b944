#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "api/plant/plant_file.hpp"
#include "core/localisation/igps_pose.hpp"
#include "tests/experiments/error_curves.hpp"
#include "tests/experiments/experiments.hpp"
#include "tests/experiments/stop_runs.hpp"

namespace pulseline::experiments {
namespace {

using geometry::Pose2;

constexpr int kStops = 200;
constexpr int kStopsOfAVehicle = 10;
constexpr int kStation = 3;       // four transmitters shine there; the wing panel shades the others
constexpr int kOther = 2;         // so that each stop ends a drive
constexpr double kWang_mm = 0.5;  // section 5, Fig. 11
constexpr double k95 = 1.959964;
constexpr double kCoveredAtLeast = 0.9;  // machines of one world share its transmitters' errors
constexpr double kCell_m = 0.5;

struct Summary {
    int stops = 0;
    int refused = 0;
    double mean_mm = 0;
    double axis_mm = 0;  // most along an axis of the station
    double sigma_mm = 0;
    double covered = 0;
    std::string why_not;
};

Summary summary_of(const std::vector<Stop>& stops) {
    Summary sum;
    for (const Stop& stop : stops) {
        if (!stop.why_not.empty()) {
            ++sum.refused;
            sum.why_not = stop.why_not;
            continue;
        }
        if (stop.station != kStation) continue;
        ++sum.stops;
        sum.mean_mm += 1e3 * norm(stop.off.position());
        sum.axis_mm =
            std::max({sum.axis_mm, 1e3 * std::abs(stop.off.x_m), 1e3 * std::abs(stop.off.y_m)});
        sum.sigma_mm += 1e3 * stop.sigma_xy_m;
        const Pose2 wrong{stop.measured.x_m - stop.off.x_m, stop.measured.y_m - stop.off.y_m, 0};
        sum.covered += 0.5 * (std::abs(wrong.x_m) <= k95 * stop.sigma_xy_m);
        sum.covered += 0.5 * (std::abs(wrong.y_m) <= k95 * stop.sigma_xy_m);
    }
    if (sum.stops > 0) {
        sum.mean_mm /= sum.stops;
        sum.sigma_mm /= sum.stops;
        sum.covered /= sum.stops;
    }
    return sum;
}

struct Loss {
    std::string name;
    std::vector<std::string> dark;
    std::size_t left = 0;
};

plant::Plant cell_of(const Options& options) {
    auto plant =
        api::plant_file::load_plant_file(options.folder + "/../../db/plants/igps-cell.json");
    if (!plant) throw std::runtime_error(plant.error().what);
    return std::move(*plant);
}

bool print_stops(const Options& options) {
    const int count = options.runs.value_or(kStops);
    StopRuns runs;
    runs.stops = 2 * std::min(count, kStopsOfAVehicle);
    runs.vehicles = (2 * count + runs.stops - 1) / runs.stops;
    runs.seed = options.seed;
    runs.errors = localisation::ErrorBudget::named(options.errors);
    runs.spoil_m = options.spoil_mm / 1e3;
    StopFamily family{"Mecanum, iGPS", "OM-01", {kStation, kOther}, true, 0.0004};
    family.plant = "igps-cell";
    fmt::print(
        "\nWang, section 5: {} stops at station {} of the iGPS cell, steered and measured by "
        "light; the true pose against the drawing, mm\n",
        count, kStation);
    fmt::print("{:<34}{:>7}{:>9}{:>10}{:>9}{:>9}{:>10}\n", "", "stops", "mean", "axis max", "sigma",
               "covered", "refused");
    fmt::print("{:<34}{:>7}{:>9}{:>10}\n", "Wang", 200, "", "0.5");
    const std::vector<Loss> losses{
        {"four transmitters", {"tx-1", "tx-2"}, 4},
        {"one of them lost", {"tx-1", "tx-2", "tx-5"}, 3},
        {"two of them lost", {"tx-1", "tx-2", "tx-5", "tx-3"}, 2},
        {"three of them lost", {"tx-1", "tx-2", "tx-5", "tx-3", "tx-6"}, 1}};
    bool good = true;
    for (const Loss& loss : losses) {
        family.dark = loss.dark;
        const Summary sum =
            summary_of(run_stops(family, options.folder + "/../../db/plants", runs));
        // One transmitter tells no place: then each machine has to say so instead of standing
        // somewhere.
        const bool kept = loss.left >= 2 ? sum.refused == 0 && sum.axis_mm <= kWang_mm &&
                                               sum.covered >= kCoveredAtLeast
                                         : sum.refused == runs.vehicles && sum.stops == 0;
        good &= kept;
        fmt::print("{:<34}{:>7}{:>9.3f}{:>10.3f}{:>9.3f}{:>8.1f}%{:>10}{}\n", loss.name, sum.stops,
                   sum.mean_mm, sum.axis_mm, sum.sigma_mm, 100 * sum.covered, sum.refused,
                   kept ? "" : "  NO");
        if (sum.refused > 0) fmt::print("  {}\n", sum.why_not);
        std::fflush(stdout);
    }
    return good;
}

/// The map's colours: the darker the better, red where too few receivers see light.
std::string colour_of(std::optional<double> sigma_mm) {
    if (!sigma_mm) return "#b91c1c";
    const int shade = std::clamp(static_cast<int>(30 + 1000 * *sigma_mm), 30, 240);
    return fmt::format("rgb({0},{0},255)", shade);
}

/// What the colours mean, from (0, `top`) on.
std::string legend(double top) {
    std::string legend;
    double left = 10;
    const auto add = [&](std::optional<double> sigma_mm, const std::string& text) {
        legend += fmt::format(
            "<rect x=\"{}\" y=\"{}\" width=\"16\" height=\"16\" fill=\"{}\"/>"
            "<text x=\"{}\" y=\"{}\">{}</text>\n",
            left, top + 8, colour_of(sigma_mm), left + 20, top + 21, text);
        left += 110;
    };
    for (const double sigma_mm : {0.05, 0.1, 0.15, 0.2}) {
        add(sigma_mm, fmt::format("{} mm", sigma_mm));
    }
    add(std::nullopt, "too little light");
    return legend;
}

/// How well the light tells a pose, over the cell.
void print_map(const Options& options) {
    const plant::Plant plant = cell_of(options);
    const auto& hall = plant.halls.front();
    const auto& type = *plant::find_vehicle_type(plant, plant.vehicles.front().type);
    const auto box = geometry::bounding_box(hall.outline);
    std::vector<double> sigmas_mm;
    int dark = 0;
    std::string cells;
    constexpr double kPixel = 12;
    for (double y_m = box.min.y_m + kCell_m / 2; y_m < box.max.y_m; y_m += kCell_m) {
        for (double x_m = box.min.x_m + kCell_m / 2; x_m < box.max.x_m; x_m += kCell_m) {
            const auto fix = localisation::expected_fix(plant, hall.id, type, {x_m, y_m, 0});
            std::optional<double> sigma_mm;
            if (fix) sigma_mm = 1e3 * fix->fix.sigma_xy_m;
            sigma_mm ? sigmas_mm.push_back(*sigma_mm) : void(++dark);
            cells += fmt::format(
                "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                (x_m - box.min.x_m) / kCell_m * kPixel, (box.max.y_m - y_m) / kCell_m * kPixel,
                kPixel, kPixel, colour_of(sigma_mm));
        }
    }
    const auto at = [&](double share) { return quantile(sigmas_mm, share); };
    fmt::print(
        "\nlight over the cell, {} places {} m apart: sigma {:.3f} mm at best, {:.3f} half of "
        "them, {:.3f} 95 %, {:.3f} at worst; {} places dark\n",
        sigmas_mm.size() + static_cast<std::size_t>(dark), kCell_m, at(0), at(0.5), at(0.95), at(1),
        dark);
    const double high = (box.max.y_m - box.min.y_m) / kCell_m * kPixel + kPixel;
    const std::string file = options.plots + "/igps.svg";
    std::ofstream svg(file);
    svg << fmt::format(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
               "font-family=\"sans-serif\" font-size=\"13\">\n"
               "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n<g id=\"cell\">\n",
               (box.max.x_m - box.min.x_m) / kCell_m * kPixel, high + 32)
        << cells << "</g>\n"
        << legend(high) << "</svg>\n";
    if (!svg.flush()) throw std::runtime_error("cannot write " + file);
    fmt::print("drawn in {}\n", file);
}

}  // namespace

bool igps(const Options& options) {
    const bool good = print_stops(options);
    print_map(options);
    return good;
}

}  // namespace pulseline::experiments
