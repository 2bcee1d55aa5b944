#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// What the fleet sets in motion by itself: one file a phase, and here the order in which they run.
namespace pulseline::fleet {

void dispatch(FleetState& fleet, Time now);
/// What a report of one vehicle can set in motion at once: its base, its next step. The rest waits
/// for the next tick, so that a report costs the same in a fleet of a thousand.
void dispatch_for(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
