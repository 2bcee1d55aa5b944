#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// Codes that a vehicle passes over: by them it corrects where it believes to be while it drives.
namespace pulseline::fleet {

/// Puts observeMarkers on the edges of an order that pass over codes, for a vehicle that announces
/// it, and says which of them its leg relies on (leg_markers). REQUIRES: the order is of its leg.
void observe_markers(const FleetState& fleet, const LiveVehicle& live, const std::string& hall,
                     vda5050::OrderMessage& order);

}  // namespace pulseline::fleet
