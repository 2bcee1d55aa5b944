#include "core/kinematics/steered_platform.hpp"

#include <cmath>

namespace pulseline::kinematics {
namespace {

/// Steering is the same for a direction and its opposite: the angle in (-pi/2, pi/2].
double steering(double right, double forward) {
    if (right == 0) return 0;
    return forward == 0 ? kPi / 2 : std::atan(right / forward);
}

}  // namespace

TangPoint to_tang(geometry::Point2 body) { return {body.x_m, -body.y_m}; }

double arc_wheel_angle_rad(TangPoint wheel, double rho_m) {
    return steering(wheel.x_m, rho_m - wheel.y_m);
}

double turn_wheel_angle_rad(TangPoint wheel) { return steering(wheel.x_m, -wheel.y_m); }

double arc_wheel_path_m(TangPoint wheel, double rho_m, double gamma_rad) {
    return std::hypot(wheel.x_m, wheel.y_m - rho_m) * gamma_rad;
}

std::vector<double> arc_wheel_angles_rad(const plant::VehicleType& type, double rho_m) {
    std::vector<double> angles;
    for (const plant::Wheel& wheel : type.wheels) {
        angles.push_back(arc_wheel_angle_rad(to_tang(wheel.position), rho_m));
    }
    return angles;
}

}  // namespace pulseline::kinematics
