#pragma once

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

/// What the planner is asked for a drive of this vehicle, as loaded as it is.
planning::LegRequest leg_request(const FleetState& fleet, const LiveVehicle& live,
                                 const Pose2& start, const plant::StationId& target,
                                 plant::MotionMode mode);

}  // namespace pulseline::fleet
