#include "core/onboard/motion/twist_reference.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/kinematics/rolling_wheels.hpp"

namespace pulseline::onboard {
namespace {

using kinematics::Twist;

constexpr double kReached = 1e-12;  // share of a change that counts as all of it

Twist times(double share, const Twist& twist) {
    return {share * twist.vx_mps, share * twist.vy_mps, share * twist.turn_radps};
}

/// Share of a change that is possible when only `most` of its `size` is.
double share_of(double most, double size) { return size > most ? most / size : 1; }

}  // namespace

TwistReference::TwistReference(const plant::VehicleType& type, double time_factor)
    : type_(type),
      time_factor_(time_factor),
      max_accel_mps2_(type.max_accel_mps2 * time_factor * time_factor),
      max_turn_accel_radps2_(type.max_turn_accel_radps2 * time_factor * time_factor) {}

void TwistReference::ask(const Pose2& from, const Twist& twist) {
    if (!active_) pose_ = from;
    active_ = true;
    // The limits are those of the vehicle's own time.
    asked_ = times(time_factor_, kinematics::within_limits(type_, times(1 / time_factor_, twist)));
    end_if_done();
}

void TwistReference::step(double h_s, double share) {
    if (!active_) return;
    const Twist goal = times(share, asked_);
    const Twist change{goal.vx_mps - twist_.vx_mps, goal.vy_mps - twist_.vy_mps,
                       goal.turn_radps - twist_.turn_radps};
    const double part =
        std::min(share_of(max_accel_mps2_ * h_s, std::hypot(change.vx_mps, change.vy_mps)),
                 share_of(max_turn_accel_radps2_ * h_s, std::abs(change.turn_radps)));
    if (part >= 1 - kReached) {
        twist_ = goal;
    } else {
        twist_.vx_mps += part * change.vx_mps;
        twist_.vy_mps += part * change.vy_mps;
        twist_.turn_radps += part * change.turn_radps;
    }
    pose_ = moved(pose_, twist_, h_s);
    end_if_done();
}

void TwistReference::drop() {
    assert(standing());
    active_ = false;
    asked_ = {};
}

double TwistReference::braking_m() const {
    const double speed = std::hypot(twist_.vx_mps, twist_.vy_mps);
    return speed * speed / (2 * max_accel_mps2_);
}

}  // namespace pulseline::onboard
