#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// Where a vehicle stands by what it says that it sees, worked out here: the server owns the
/// survey.
namespace pulseline::fleet {

struct SeenPose {
    Pose2 pose;
    PoseBasis::Kind basis = PoseBasis::Kind::kCodes;  // or kReceivers, kReflectors
    double sigma_xy_m = 0;                            // the worse axis
    double sigma_heading_rad = 0;
};

/// How far from where a vehicle says to stand its reflectors are looked for. Through a hall of many
/// that stand alike it takes tens of milliseconds, so that nobody may have it done with each state.
enum class Reach { kNearIt, kWholeHall };

/// By its receivers of iGPS, else by the codes below its cameras, else by the reflectors around;
/// nothing: they do not tell.
std::optional<SeenPose> seen_pose(const FleetState& fleet, const LiveVehicle& live, Reach reach);

}  // namespace pulseline::fleet
