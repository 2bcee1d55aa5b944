#include "core/plant/carrying.hpp"

#include <algorithm>

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

}  // namespace pulseline::plant
