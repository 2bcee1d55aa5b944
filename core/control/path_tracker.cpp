#include "core/control/path_tracker.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::control {
namespace {

using geometry::Point2;

constexpr double kConverge_m = 1.0;   // way over which an error falls to 1/e
constexpr double kAlong_per_s = 0.8;  // well below the position loops of the wheels, 3.5 per s
constexpr double kLeastReach_m = 0.3;
constexpr double kMoving = 1e-9;  // m/s
// Differential: both poles of the error across the path at 1 / kBend_m (per metre driven).
constexpr double kBend_m = 0.7;

/// Farthest wheel from the centre: a turn counts as the way driven there.
double reach_m(const plant::VehicleType& type) {
    double reach = kLeastReach_m;
    for (const auto& wheel : type.wheels) reach = std::max(reach, norm(wheel.position));
    return reach;
}

/// Way per second, of the centre or of the outermost wheel.
double pace_mps(const plant::VehicleType& type, const Twist& twist) {
    return std::hypot(twist.vx_mps, twist.vy_mps) + std::abs(twist.turn_radps) * reach_m(type);
}

Twist any_direction(const Twist& wanted, const Pose2& error, double pace) {
    const Pose2 body_from_reference{0, 0, error.heading_rad};
    const Point2 forward = body_from_reference * Point2{wanted.vx_mps, wanted.vy_mps};
    const double speed = norm(forward);
    Point2 along;
    if (speed > kMoving) {
        const Point2 direction = (1 / speed) * forward;
        along = dot(error.position(), direction) * direction;
    }
    const Point2 across = error.position() - along;
    const Point2 v = forward + kAlong_per_s * along + (pace / kConverge_m) * across;
    return {v.x_m, v.y_m, wanted.turn_radps + pace / kConverge_m * error.heading_rad};
}

Twist forwards_only(const Twist& wanted, const Pose2& error, double pace) {
    const double v = wanted.vx_mps;
    const double a = error.heading_rad;
    const double sinc = std::abs(a) < 1e-6 ? 1 : std::sin(a) / a;
    const double along = std::abs(v) > kMoving ? kAlong_per_s * error.x_m : 0;
    return {v * std::cos(a) + along, 0,
            wanted.turn_radps + v * sinc * error.y_m / (kBend_m * kBend_m) +
                2 * pace / kBend_m * std::sin(a)};
}

}  // namespace

Twist track(const plant::VehicleType& type, const Reference& reference, const Pose2& estimated) {
    const Pose2 error = inverse(estimated) * reference.pose;
    const double pace = pace_mps(type, reference.twist);
    const bool differential = type.kinematics == plant::Kinematics::kDifferential;
    return kinematics::within_limits(type, differential
                                               ? forwards_only(reference.twist, error, pace)
                                               : any_direction(reference.twist, error, pace));
}

}  // namespace pulseline::control
