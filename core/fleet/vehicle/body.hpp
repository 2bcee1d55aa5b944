#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// The body that a vehicle has now, and how fast it is.
namespace pulseline::fleet {

/// Vehicle's outline (with its load) at a pose, convex pieces in the hall frame.
std::vector<geometry::Polygon> outline_at(const LiveVehicle& live, const Pose2& pose);
bool is_loaded(const LiveVehicle& live);
/// Speed of the vehicle by its own factsheet over that of its type in the plant.
double speed_share(const LiveVehicle& live);
/// Top speed and acceleration, of its own factsheet where it has told them.
double speed_of(const LiveVehicle& live);
double accel_of(const LiveVehicle& live);

}  // namespace pulseline::fleet
