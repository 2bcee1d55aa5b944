#include "core/plant/carrying.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "core/plant/load_rules.hpp"

namespace pulseline::plant {
namespace {

bool is_within(const VehicleType& type, const Polygon& outline) {
    return std::ranges::all_of(outline, [&](Point2 corner) {
        const auto pieces = outline_with_load(type, true);
        return std::ranges::any_of(
            pieces, [&](const Polygon& piece) { return geometry::contains(piece, corner); });
    });
}

}  // namespace

std::optional<Reason> cannot_carry(const VehicleType& type, const Load& load) {
    const auto& named = load.vehicle_types;
    const bool may =
        named.empty() ? !type.brackets.empty() : std::ranges::find(named, type.id) != named.end();
    if (!may) {
        return Reason{"load_not_for_type", {{"load", load.name}, {"type", type.id.str()}}};
    }
    if (load.mass_kg > type.max_load_kg) {
        return Reason{"load_too_heavy",
                      {{"load_kg", load.mass_kg}, {"max_load_kg", type.max_load_kg}}};
    }
    if (!is_within(type, load.outline)) {
        return Reason{"load_too_large", {{"load", load.name}, {"type", type.id.str()}}};
    }
    return std::nullopt;
}

std::optional<Reason> cannot_carry_by_papers(const VehicleType& type, const Load& load) {
    if (auto why_not = cannot_carry(type, load)) return why_not;
    if (type.brackets.empty()) return std::nullopt;
    const Point2 centre = bracket_middle(type) + load.centre;
    // Of some types nobody has said where the wheels are.
    if (!is_within(type, {centre})) {
        return Reason{"load_outside_wheel_base", {{"x_m", centre.x_m}, {"y_m", centre.y_m}}};
    }
    return centre_fault(type, centre);
}

std::optional<Reason> nobody_can_carry(const Plant& plant, const Load& load) {
    constexpr std::array<std::string_view, 3> kFirst{"load_not_for_type", "load_too_heavy",
                                                     "load_too_large"};
    const auto nearness = [&](const Reason& reason) {
        return std::distance(kFirst.begin(), std::ranges::find(kFirst, reason.code));
    };
    std::optional<Reason> nearest;
    for (const VehicleType& type : plant.vehicle_types) {
        auto why_not = cannot_carry_by_papers(type, load);
        if (!why_not) return std::nullopt;
        if (!nearest || nearness(*nearest) < nearness(*why_not)) nearest = std::move(why_not);
    }
    return nearest;
}

}  // namespace pulseline::plant
