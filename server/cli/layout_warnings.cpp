#include "server/cli/layout_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/fleet/tables/code_gaps.hpp"
#include "core/fleet/tables/code_speeds.hpp"
#include "core/fleet/tables/layout.hpp"
#include "core/fleet/tables/light_gaps.hpp"
#include "core/traffic/layout_check.hpp"

namespace pulseline::server::cli {
namespace {

template <class Value>
Value value_of(const Reason& reason, const char* name) {
    const auto found = std::find_if(reason.params.begin(), reason.params.end(),
                                    [&](const Param& param) { return param.name == name; });
    return found == reason.params.end() ? Value{} : std::get<Value>(found->value);
}

std::string pairs(std::int64_t count) {
    return count == 1 ? std::string("this pair of stations")
                      : fmt::format("{} pairs of stations like this", count);
}

std::string station_pointer(const plant::Plant& plant, const std::string& station) {
    for (std::size_t i = 0; i < plant.stations.size(); ++i) {
        if (plant.stations[i].id.str() == station) return fmt::format("/stations/{}", i);
    }
    return "/stations";
}

plant::Fault unreachable(const plant::Plant& plant, const Reason& reason) {
    const auto text = [&](const char* name) { return value_of<std::string>(reason, name); };
    const std::string crossing = text("crossing");
    const std::string concerned = pairs(value_of<std::int64_t>(reason, "count"));
    if (crossing.empty()) {
        return {station_pointer(plant, text("to")), reason.code,
                fmt::format("Vehicles of type {} have no way from {} to {} even on an empty floor "
                            "({}).",
                            text("class"), text("from"), text("to"), concerned),
                "Join the stations by roads or free floor, or exclude the type from one of them."};
    }
    return {station_pointer(plant, crossing), reason.code,
            fmt::format("A vehicle that rests at {} keeps vehicles of type {} from driving from {} "
                        "to {} ({}).",
                        crossing, text("class"), text("from"), text("to"), concerned),
            fmt::format("Make {} no resting place, move it out of the way, or add a way past it.",
                        crossing)};
}

plant::Fault too_few_resting_places(const Reason& reason) {
    const auto of_class = value_of<std::string>(reason, "class");
    return {"/stations", reason.code,
            fmt::format("{} {} can rest at {} places that share no floor.",
                        value_of<std::int64_t>(reason, "vehicles"),
                        of_class.empty() ? "vehicles" : "vehicles of type " + of_class,
                        value_of<std::int64_t>(reason, "resting_places")),
            "Add stations with resting_place for them, apart from each other."};
}

plant::Fault code_gap(const Reason& reason) {
    const auto metres = [&](const char* name) { return value_of<double>(reason, name); };
    const auto pieces = value_of<std::int64_t>(reason, "count");
    const double blind_m = metres("blind_m");
    return {"/markers", reason.code,
            fmt::format("Vehicles of type {} drive {} where they may drive {:.1f} m to be sure of "
                        "the next code ({}).",
                        value_of<std::string>(reason, "class"),
                        blind_m > 0 ? fmt::format("{:.1f} m without a code", blind_m)
                                    : std::string("lanes without any code"),
                        metres("at_most_m"),
                        pieces == 1 ? std::string("one piece of lane")
                                    : fmt::format("{} pieces of lanes", pieces)),
            fmt::format("Lay a code below their cameras' way near x {:.1f} m, y {:.1f} m and add "
                        "it to markers.",
                        metres("at_x_m"), metres("at_y_m"))};
}

plant::Fault codes_too_fast(const plant::Plant& plant, const Reason& reason) {
    const auto of_class = value_of<std::string>(reason, "class");
    std::string pointer = "/vehicle_types";
    for (std::size_t i = 0; i < plant.vehicle_types.size(); ++i) {
        const std::string id = plant.vehicle_types[i].id.str();
        if (of_class == id || of_class == id + " with load") pointer += fmt::format("/{}", i);
    }
    return {pointer, reason.code,
            fmt::format("Vehicles of type {} drive {:.2f} m/s and surely read a code up to {:.2f} "
                        "m/s only: over each that their way relies on they are slowed down.",
                        of_class, value_of<double>(reason, "max_speed_mps"),
                        value_of<double>(reason, "speed_mps")),
            "Use smaller codes, cameras that see more floor or take more pictures a second, or "
            "lower max_speed_mps."};
}

plant::Fault light_gap(const Reason& reason) {
    const auto places = value_of<std::int64_t>(reason, "count");
    return {
        "/transmitters", reason.code,
        fmt::format("Vehicles of type {} do not know where they are near x {:.1f} m, y {:.1f} m "
                    "({}): {}",
                    value_of<std::string>(reason, "class"), value_of<double>(reason, "at_x_m"),
                    value_of<double>(reason, "at_y_m"),
                    places == 1 ? std::string("one place") : fmt::format("{} places", places),
                    value_of<std::string>(reason, "why")),
        "Set up a transmitter that shines there and add it to transmitters."};
}

}  // namespace

std::vector<plant::Fault> layout_warnings(const plant::Plant& plant) {
    std::vector<plant::Fault> warnings;
    for (const Reason& reason : fleet::check_layout(plant)) {
        if (reason.code == traffic::kLayoutUnreachable) {
            warnings.push_back(unreachable(plant, reason));
        } else if (reason.code == fleet::kCodeGap) {
            warnings.push_back(code_gap(reason));
        } else if (reason.code == fleet::kCodesTooFast) {
            warnings.push_back(codes_too_fast(plant, reason));
        } else if (reason.code == fleet::kLightGap) {
            warnings.push_back(light_gap(reason));
        } else {
            warnings.push_back(too_few_resting_places(reason));
        }
    }
    return warnings;
}

}  // namespace pulseline::server::cli
