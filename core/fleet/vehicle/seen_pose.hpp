#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// Where a vehicle stands by what it says that it sees, worked out here: the server owns the
/// survey.
namespace pulseline::fleet {

struct SeenPose {
    Pose2 pose;
    PoseBasis::Kind basis = PoseBasis::Kind::kCodes;  // or kReceivers, kReflectors
};

/// By its receivers of iGPS, else by the codes below its cameras, else by the reflectors around;
/// nothing: they do not tell.
std::optional<SeenPose> seen_pose(const FleetState& fleet, const LiveVehicle& live);

}  // namespace pulseline::fleet
