#pragma once

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

/// What the planner is asked for a drive of this vehicle, as loaded as it is.
planning::LegRequest leg_request(const FleetState& fleet, const LiveVehicle& live,
                                 const Pose2& start, const plant::StationId& target,
                                 plant::MotionMode mode);

/// As the crow flies, at top speed.
double least_drive_s(const LiveVehicle& live, const Pose2& from, const plant::Station& to);
/// Whether the vehicle stands so near the station's pose that only the stop has to be corrected.
bool nearly_there(const LiveVehicle& live, const Pose2& pose, const plant::Station& station);

}  // namespace pulseline::fleet
