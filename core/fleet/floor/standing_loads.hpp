#pragma once

#include <vector>

#include "core/base/result.hpp"
#include "core/fleet/state/fleet_state.hpp"

/// Loads on hoists and stands: who carries nothing passes below, who carries something would run
/// into them.
namespace pulseline::fleet {

/// Closes the room of those that stand now to traffic, and opens that of those that are gone. True
/// when there were any: planning is to know it (closures.hpp).
bool update_standing_loads(FleetState& fleet, Time now);
/// As planning takes them.
std::vector<planning::ClosedFloor> closed_to_loads(const FleetState& fleet);
/// Whose room it is; nullptr: nobody's.
const StandingLoad* standing_load_at(const FleetState& fleet, traffic::TileId tile);
/// Names it: load_in_the_way {load, station}.
Reason load_in_the_way(const FleetState& fleet, const StandingLoad& standing);
/// Nobody with a load stands or is granted to drive where it shall be from now on, but `from`,
/// which has set it down. Errors: floor_held {vehicle}.
Status has_room_at(const FleetState& fleet, const plant::Load& load, const plant::Station& station,
                   const plant::VehicleId& from);

}  // namespace pulseline::fleet
