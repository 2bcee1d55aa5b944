#pragma once

#include <span>
#include <vector>

#include "core/kinematics/wheels.hpp"

namespace pulseline::kinematics {

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
