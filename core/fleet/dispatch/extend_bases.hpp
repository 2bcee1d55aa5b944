#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Further base for vehicles that drive.
namespace pulseline::fleet {

/// Vehicles at work get further base.
void extend_bases(FleetState& fleet, Time now);
bool may_extend_base(const FleetState& fleet, const LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
