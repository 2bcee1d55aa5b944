#include "core/kinematics/rolling_wheels.hpp"

#include <cmath>

namespace pulseline::kinematics {

using geometry::Point2;
using geometry::Pose2;

double rolling_speed(const plant::VehicleType& type, const plant::Wheel& wheel, double angle_rad,
                     const Twist& twist) {
    const Point2 floor{twist.vx_mps - twist.turn_radps * wheel.position.y_m,
                       twist.vy_mps + twist.turn_radps * wheel.position.x_m};
    if (type.kinematics == plant::Kinematics::kMecanum && !wheel.steered) {
        // Rollers at 45 degrees (Wang).
        return floor.x_m + (wheel.position.x_m * wheel.position.y_m > 0 ? -1 : 1) * floor.y_m;
    }
    return floor.x_m * std::cos(angle_rad) + floor.y_m * std::sin(angle_rad);
}

Pose2 moved(const Pose2& pose, const Twist& twist, double h_s) {
    const double turn_rad = twist.turn_radps * h_s;
    const Pose2 halfway{pose.x_m, pose.y_m, pose.heading_rad + turn_rad / 2};
    const Point2 to = halfway * Point2{twist.vx_mps * h_s, twist.vy_mps * h_s};
    return {to.x_m, to.y_m, wrap(pose.heading_rad + turn_rad)};
}

RollingWheels::RollingWheels(const plant::VehicleType& vehicle) : type(vehicle) {
    for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
        if (vehicle.wheels[i].driven) index.push_back(i);
    }
    if (index.size() < 2) {
        index.clear();
        for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) index.push_back(i);
    }
    type.wheels.clear();
    for (const std::size_t i : index) type.wheels.push_back(vehicle.wheels[i]);
}

BodyMotion RollingWheels::body_of(std::span<const WheelMotion> all) const {
    std::vector<WheelMotion> own(index.size());
    for (std::size_t i = 0; i < index.size(); ++i) own[i] = all[index[i]];
    return kinematics::body_of(type, own);
}

}  // namespace pulseline::kinematics
