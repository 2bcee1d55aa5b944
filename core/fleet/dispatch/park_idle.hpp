#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Vehicles without an order that may not stay, or stand where others want to go.
namespace pulseline::fleet {

/// Idle vehicles leave where they may not stay, and floor that others wait for.
void park_idle(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
