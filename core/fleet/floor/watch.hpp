#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// The monitor's view of the floor: what is about to be said is held against it.
namespace pulseline::fleet {

/// Feeds the monitor; false: it found a violation, and nothing may be granted.
bool floor_is_sound(FleetState& fleet, Time now);
/// What the vehicle is about to be told, its leg up to `nodes`, held against the floor that the
/// monitor knows it to hold: leg and plan must not have come apart. False as above.
bool keeps_to_its_floor(FleetState& fleet, const LiveVehicle& live, std::size_t nodes, Time now);
/// Everything anew, once a second when something has changed.
void check_whole_floor(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
