#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Codes that a vehicle passes over: by them it corrects where it believes to be while it drives.
namespace pulseline::fleet {

/// The surveyed codes of the hall that a camera of the type sees whole while its body drives the
/// segment, as far as the middle of the picture's short side reaches beside the way; in the order
/// of the plant. Those of a usual stop are among them.
std::vector<const plant::Marker*> markers_below(const std::vector<const plant::Marker*>& around,
                                                const plant::VehicleType& type, bool loaded,
                                                const kinematics::Segment& segment);

/// Puts observeMarkers on the edges of an order that pass over codes, for a vehicle that announces
/// it.
void observe_markers(const FleetState& fleet, const LiveVehicle& live, const std::string& hall,
                     vda5050::OrderMessage& order);

}  // namespace pulseline::fleet
