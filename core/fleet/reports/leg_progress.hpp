#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// What a vehicle reports of its leg.
namespace pulseline::fleet {

/// Follows the vehicle along its leg: the nodes it has passed, its actions, its stop, its end.
void handle_leg_progress(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
