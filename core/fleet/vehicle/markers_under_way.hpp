#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// Codes that a vehicle passes over: by them it corrects where it believes to be while it drives.
namespace pulseline::fleet {

/// Puts observeMarkers on the edges of an order that pass over codes, for a vehicle that announces
/// it, and says which of them its leg relies on (leg_markers). Where it would pass one of these too
/// fast to read it surely (localisation::limit_to_read_mps), the edge's maxSpeed keeps it from
/// that; durations do not count it, it is on a few metres. REQUIRES: the order is of its leg.
void observe_markers(const FleetState& fleet, const LiveVehicle& live, const std::string& hall,
                     vda5050::OrderMessage& order);

}  // namespace pulseline::fleet
