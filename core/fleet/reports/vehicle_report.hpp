#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// A vehicle's state message, step by step.
namespace pulseline::fleet {

void handle_state(FleetState& fleet, LiveVehicle& live, const vda5050::StateMessage& state,
                  Time now);

}  // namespace pulseline::fleet
