#include "core/kinematics/wheels.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace pulseline::kinematics {
namespace {

using plant::Kinematics;
using plant::Wheel;

constexpr double kNoSpeed_mps = 1e-9;

/// How fast the floor passes below a wheel.
geometry::Point2 velocity_at(geometry::Point2 place, const Twist& twist) {
    return {twist.vx_mps - twist.turn_radps * place.y_m,
            twist.vy_mps + twist.turn_radps * place.x_m};
}

/// Rollers of the wheels at front left and rear right lead to the right, the others to the left
/// (Wang; rollers at 45 degrees): +1 where a rim turning forward drives to the left.
double roller_side(const Wheel& wheel) {
    return wheel.position.x_m * wheel.position.y_m > 0 ? -1 : 1;
}

/// Of a direction and its opposite what turns less from `present_rad` inside the limit.
double steering_angle(double direction_rad, double present_rad, double limit_rad) {
    const double opposite_rad = wrap(direction_rad + kPi);
    const auto badness = [&](double angle_rad) {
        // Rounding must not throw out both of a quarter turn's two.
        const bool outside = std::abs(angle_rad) > limit_rad + 1e-9;
        return std::pair(outside, std::abs(angle_rad - present_rad));
    };
    return badness(direction_rad) <= badness(opposite_rad) ? direction_rad : opposite_rad;
}

WheelMotion steered(const Wheel& wheel, const Twist& twist, double present_rad, double limit_rad) {
    const geometry::Point2 v = velocity_at(wheel.position, twist);
    if (std::hypot(v.x_m, v.y_m) < kNoSpeed_mps) return {present_rad, 0};
    const double angle = steering_angle(std::atan2(v.y_m, v.x_m), present_rad, limit_rad);
    return {angle, v.x_m * std::cos(angle) + v.y_m * std::sin(angle)};
}

Eigen::RowVector3d row_along(const Wheel& wheel, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c, s, s * wheel.position.x_m - c * wheel.position.y_m};
}

}  // namespace

Result<std::vector<WheelMotion>> wheels_of(const plant::VehicleType& type, const Twist& twist,
                                           std::span<const WheelMotion> present,
                                           double steering_limit_rad) {
    assert(present.empty() || present.size() == type.wheels.size());
    assert(steering_limit_rad >= kPi / 2);
    std::vector<WheelMotion> wheels;
    for (std::size_t i = 0; i < type.wheels.size(); ++i) {
        const Wheel& wheel = type.wheels[i];
        const geometry::Point2 v = velocity_at(wheel.position, twist);
        if (wheel.steered) {
            wheels.push_back(steered(wheel, twist, present.empty() ? 0 : present[i].angle_rad,
                                     steering_limit_rad));
        } else if (type.kinematics == Kinematics::kMecanum) {
            wheels.push_back({0, v.x_m + roller_side(wheel) * v.y_m});
        } else if (std::abs(v.y_m) < kNoSpeed_mps) {
            wheels.push_back({0, v.x_m});
        } else {
            return fail(Errc::kUnreachable, "cannot_move_so",
                        "Wheel " + wheel.name + " would be dragged sideways.", {},
                        {{"wheel", wheel.name}, {"sideways_mps", v.y_m}});
        }
    }
    return wheels;
}

BodyMotion body_of(const plant::VehicleType& type, std::span<const WheelMotion> wheels) {
    assert(wheels.size() == type.wheels.size());
    // What each wheel says of the twist: how fast it rolls and, but for rollers, that it does not
    // slide sideways.
    Eigen::MatrixX3d rows(2 * static_cast<Eigen::Index>(wheels.size()), 3);
    Eigen::VectorXd speeds(rows.rows());
    Eigen::Index n = 0;
    const auto add = [&](const Eigen::RowVector3d& row, double speed_mps) {
        rows.row(n) = row;
        speeds[n++] = speed_mps;
    };
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        const Wheel& wheel = type.wheels[i];
        const auto along = row_along(wheel, wheels[i].angle_rad);
        const auto across = row_along(wheel, wheels[i].angle_rad + kPi / 2);
        if (type.kinematics == Kinematics::kMecanum && !wheel.steered) {
            add(along + roller_side(wheel) * across, wheels[i].speed_mps);
        } else {
            add(along, wheels[i].speed_mps);
            add(across, 0);
        }
    }
    BodyMotion body;
    if (n == 0) return body;
    const auto a = rows.topRows(n);
    const auto b = speeds.head(n);
    const Eigen::Vector3d twist = a.completeOrthogonalDecomposition().solve(b);
    body.twist = {twist.x(), twist.y(), twist.z()};
    body.slip_mps = (a * twist - b).norm() / std::sqrt(static_cast<double>(n));
    return body;
}

double most_times(const plant::VehicleType& type, const Twist& twist) {
    double times = std::numeric_limits<double>::infinity();
    const auto limit = [&](double rate, double most) {
        if (rate != 0) times = std::min(times, most / std::abs(rate));
    };
    limit(twist.turn_radps, type.max_turn_rate_radps);
    limit(std::hypot(twist.vx_mps, twist.vy_mps), type.max_speed_mps);
    for (const Wheel& wheel : type.wheels) {
        const geometry::Point2 v = velocity_at(wheel.position, twist);
        const bool rollers = type.kinematics == Kinematics::kMecanum && !wheel.steered;
        limit(rollers ? v.x_m + roller_side(wheel) * v.y_m : std::hypot(v.x_m, v.y_m),
              type.max_speed_mps);
    }
    return times;
}

Twist within_limits(const plant::VehicleType& type, const Twist& twist) {
    const double times = std::min(1.0, most_times(type, twist));
    return {times * twist.vx_mps, times * twist.vy_mps, times * twist.turn_radps};
}

double steering_duration_s(const plant::VehicleType& type, std::span<const WheelMotion> from,
                           std::span<const WheelMotion> to) {
    assert(from.size() == type.wheels.size() && to.size() == type.wheels.size());
    double turn_rad = 0;
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (type.wheels[i].steered)
            turn_rad = std::max(turn_rad, std::abs(to[i].angle_rad - from[i].angle_rad));
    }
    return turn_rad / type.max_steering_rate_radps;
}

}  // namespace pulseline::kinematics
