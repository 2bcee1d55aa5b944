#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Orders of vehicles that were taken out.
namespace pulseline::fleet {

/// Orders of vehicles that were taken out wait for others.
void release_withdrawn(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
