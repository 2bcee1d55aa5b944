#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// The next drive of orders that have a vehicle.
namespace pulseline::fleet {

/// Assigned orders start their next step, and legs without a plan get one.
void start_steps(FleetState& fleet, Time now);
void start_step(FleetState& fleet, JobOrder& order, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
