#pragma once

#include <vector>

#include "core/plant/plant.hpp"

/// Wheels of Tang's platform (Tang 2020 eq. 3, 10, 11, corrected). Angles, turns and the signed
/// radius rho are as in the paper: clockwise positive, rho > 0 when the centre lies on the right.
/// The paper's frame has y to the right; plant data have y to the left and are converted here only.
namespace pulseline::kinematics {

/// A wheel's place in Tang's frame: x forward, y to the RIGHT.
struct TangPoint {
    double x_m = 0;
    double y_m = 0;
};
TangPoint to_tang(geometry::Point2 body);

/// Steering angle theta_i on an arc about (0, rho), in (-pi/2, pi/2).
double arc_wheel_angle_rad(TangPoint wheel, double rho_m);
/// Steering angle for a turn about the platform's own centre; a wheel in the centre stays straight.
double turn_wheel_angle_rad(TangPoint wheel);
/// Way of the wheel's contact point over a central angle gamma (S1).
double arc_wheel_path_m(TangPoint wheel, double rho_m, double gamma_rad);

/// Angles of all wheels of a type, in its order of wheels.
std::vector<double> arc_wheel_angles_rad(const plant::VehicleType& type, double rho_m);

}  // namespace pulseline::kinematics
