#include "core/fleet/floor/carrying.hpp"

#include <utility>

#include "core/fleet/floor/closures.hpp"
#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {
namespace {

/// Who else holds floor of it; nullptr: nobody.
const std::string* other_holder(const FleetState& fleet, const LiveVehicle& live,
                                const traffic::TileSet& stand) {
    for (const auto tile : stand) {
        const auto holder = fleet.floor.traffic.holder(tile);
        if (holder && *holder != live.floor.vehicle) return &fleet.floor.traffic.name(*holder);
    }
    return nullptr;
}

}  // namespace

Status hold_floor_with(FleetState& fleet, LiveVehicle& live, const plant::Load* load, Time now) {
    if (live.load == load) return {};
    const auto* before = std::exchange(live.load, load);
    find_class(fleet, live);
    const auto& known = floor_class_of(fleet, live);
    // Where nobody knows it to stand it holds what it held until somebody does.
    const bool stands = live.record.pose_known && live.floor.pose && !live.floor.conflict;
    const auto place = stands ? place_at(fleet, live, live.record.pose) : traffic::kNoPlace;
    auto stand = stands ? floor_under(fleet, live, live.record.pose)
                        : fleet.floor.traffic.held_tiles(live.floor.vehicle);
    if (place != traffic::kNoPlace) stand = traffic::merge(stand, known.stands[place]);
    if (const auto* other = other_holder(fleet, live, stand)) {
        live.load = before;
        find_class(fleet, live);
        return fail(Errc::kConflict, "floor_held",
                    "Vehicle " + *other +
                        " holds floor below the load. Send it away, and take the load over then.",
                    {}, {{"vehicle", *other}});
    }
    // Nobody else holds any of it.
    static_cast<void>(
        fleet.floor.traffic.found_at(live.floor.vehicle, known.graph, stand, place, now));
    live.floor.leg_planned = false;
    live.swept.clear();
    live.newest_plan.reset();
    live.leg_markers.reset();
    fleet.changed_vehicles.insert(live.record.id);
    halt_or_resume(fleet, live, now);
    return {};
}

void settle_load(FleetState& fleet, LiveVehicle& live, Time now) {
    close_below_loads(fleet, now);
    if (live.has_leg() || is_transferring(live)) return;
    // It can only be less than it holds floor with: a load was not taken over, or was set down.
    static_cast<void>(hold_floor_with(fleet, live, load_on(fleet, live.record.id), now));
}

}  // namespace pulseline::fleet
