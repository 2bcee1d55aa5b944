#pragma once

#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/kinematics/wheels.hpp"

namespace pulseline::kinematics {

/// How fast a wheel standing at `angle_rad` rolls when the body moves with `twist`.
double rolling_speed(const plant::VehicleType& type, const plant::Wheel& wheel, double angle_rad,
                     const Twist& twist);

/// Pose after moving with a steady twist for `h_s` (to third order in the angle turned).
geometry::Pose2 moved(const geometry::Pose2& pose, const Twist& twist, double h_s);

/// The wheels that say how the body moves, as a type of its own: the driven ones, or all when one
/// driven wheel alone leaves something open.
struct RollingWheels {
    plant::VehicleType type;
    std::vector<std::size_t> index;  // of each among the vehicle's wheels

    explicit RollingWheels(const plant::VehicleType& vehicle);
    /// Twist and contradiction of the vehicle's wheel motions (body_of).
    BodyMotion body_of(std::span<const WheelMotion> all) const;
};

}  // namespace pulseline::kinematics
