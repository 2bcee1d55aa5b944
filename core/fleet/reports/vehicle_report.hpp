#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// A vehicle's state message, step by step.
namespace pulseline::fleet {

void take_state(FleetState& fleet, VehicleRun& run, const vda5050::StateMessage& state, Time now);

}  // namespace pulseline::fleet
