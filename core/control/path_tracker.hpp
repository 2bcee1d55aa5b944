#pragma once

#include "core/geometry/pose2.hpp"
#include "core/kinematics/wheels.hpp"
#include "core/plant/plant.hpp"

/// Keeping a vehicle on its path.
namespace pulseline::control {

using geometry::Pose2;
using kinematics::Twist;

/// Where the vehicle should be now (hall frame) and how it should move there (body frame of that
/// pose).
struct Reference {
    Pose2 pose;
    Twist twist;
};

/// The twist, in the vehicle's body frame, that brings the estimated pose (hall frame) to the
/// reference and moves on with it; inside kinematics::within_limits.
/// Vehicles that move in any direction: the reference's twist turned into the body, plus feedback.
/// Differential ones, never sideways: Kanayama, Kimura, Miyazaki, Noguchi, "A stable tracking
/// control method for an autonomous mobile robot", ICRA 1990, eq. 8, with the heading term of
/// De Luca, Oriolo, Samson 1998 (section 3.3), which works backwards too.
/// Errors across the path and of heading fall with the way driven and not with time: a slow
/// vehicle steers no harder than a fast one, and a standing one is not moved.
Twist track(const plant::VehicleType& type, const Reference& reference, const Pose2& estimated);

}  // namespace pulseline::control
