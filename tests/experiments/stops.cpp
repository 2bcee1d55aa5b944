#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "api/plant/plant_file.hpp"
#include "tests/experiments/experiments.hpp"
#include "tests/experiments/stop_runs.hpp"

namespace pulseline::experiments {
namespace {

constexpr int kStops = 200;
constexpr int kStopsOfAVehicle = 10;
constexpr double kOffset_m = 0.010;     // of a code from its camera's foot, for the terms shown
constexpr double kTwoSigma = 1.959964;  // 95 % of a normal distribution

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

/// Share of the axes of all stops on which the true place lies within two stated sigmas of the
/// measured one. Machines differ from each other, the stops of one hardly.
double covered(const std::vector<Stop>& stops) {
    return mean(stops, [](const Stop& stop) {
        const auto inside = [&](double off_m) {
            return std::abs(off_m) <= kTwoSigma * stop.sigma_xy_m ? 0.5 : 0.0;
        };
        return inside(stop.measured.x_m - stop.off.x_m) + inside(stop.measured.y_m - stop.off.y_m);
    });
}

bool keeps(const StopDemand& demand, const std::vector<Stop>& stops) {
    return most(stops, along_axis_mm) <= demand.most_axis_mm &&
           most(stops, turned_deg) <= demand.most_deg && mean(stops, away_mm) <= demand.mean_mm &&
           mean(stops, turned_deg) <= demand.mean_deg;
}

/// The terms of the stated sigma, the greatest first.
std::string terms_of(const std::string& plants, const StopFamily& family,
                     const localisation::ErrorBudget& errors) {
    const auto loaded = api::plant_file::load_plant_file(plants + "/" + family.plant + ".json");
    if (!loaded) throw std::runtime_error(loaded.error().what);
    const plant::Plant& plant = *loaded;
    if (family.igps) {
        const auto& first = plant.transmitters.front();
        return fmt::format(
            "{} transmitters: light {:.0f} urad, place {:.3f} mm, turn {:.0f} urad; receivers "
            "{:.3f} mm",
            plant.transmitters.size(), 1e6 * first.sigma_rad, 1e3 * first.sigma_place_m,
            1e6 * first.sigma_turn_rad, 1e3 * errors.receiver.place_m);
    }
    const auto& vehicle = *plant::find_vehicle(plant, plant::VehicleId(family.vehicle));
    const auto& type = *plant::find_vehicle_type(plant, vehicle.type);
    auto terms = localisation::code_terms(errors, type.cameras.front(), kOffset_m,
                                          plant::first_load(plant, vehicle.id) != nullptr);
    terms.push_back({"survey", plant.markers.front().sigma_xy_m});
    std::ranges::sort(terms, std::greater{}, &localisation::ErrorTerm::sigma_m);
    std::string text = "sigma of a code, mm:";
    for (const auto& term : terms)
        text += fmt::format("  {} {:.3f}", term.name, 1e3 * term.sigma_m);
    return text;
}

}  // namespace

bool stops(const Options& options) {
    const int count = options.runs.value_or(kStops);
    StopRuns runs;
    runs.stops = std::min(count, kStopsOfAVehicle);
    runs.vehicles = (count + runs.stops - 1) / runs.stops;
    runs.seed = options.seed;
    runs.errors = localisation::ErrorBudget::named(options.errors);
    runs.spoil_m = options.spoil_mm / 1e3;
    const std::string plants = options.folder + "/../../db/plants";
    fmt::print(
        "\n{} machines a family with {} stops each, {} errors; by the true pose against the "
        "drawing, mm and deg\n",
        runs.vehicles, runs.stops, options.errors);
    fmt::print("{:<24}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}{:>9}\n", "", "arrived", "mean",
               "axis max", "max", "deg mean", "deg max", "looks", "time s", "covered");
    bool good = true;
    for (const StopFamily& family : stop_families()) {
        auto made = run_stops(family, plants, runs);
        const auto is_refused = [](const Stop& stop) { return !stop.why_not.empty(); };
        const auto first = std::ranges::find_if(made, is_refused);
        const std::string refusal =
            first == made.end() ? ""
                                : fmt::format("station {}: {}", first->station, first->why_not);
        const auto refused = std::erase_if(made, is_refused);
        const bool kept = refused == 0 && keeps(family.demand, made);
        good &= kept;
        fmt::print(
            "{:<24}{:>9.2f}{:>9.3f}{:>9.3f}{:>9.3f}{:>9.4f}{:>9.4f}{:>7.2f}{:>8.1f}{:>8.1f}%  {}: "
            "{}\n",
            family.name, mean(made, arrived_mm), mean(made, away_mm), most(made, along_axis_mm),
            most(made, away_mm), mean(made, turned_deg), most(made, turned_deg),
            mean(made, [](const Stop& stop) { return double(stop.looks); }),
            mean(made, [](const Stop& stop) { return stop.time_s; }), 100 * covered(made),
            family.demand.words, kept ? "yes" : "NO");
        fmt::print("  {}\n", terms_of(plants, family, runs.errors));
        if (refused > 0) {
            fmt::print("  {} of {} machines refused a stop, the first at {}\n", refused,
                       runs.vehicles, refusal);
        }
        std::fflush(stdout);
    }
    return good;
}

}  // namespace pulseline::experiments
