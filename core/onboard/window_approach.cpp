#include "core/onboard/window_approach.hpp"

#include <algorithm>
#include <cmath>

#include "core/control/manoeuvre.hpp"

namespace pulseline::onboard {
namespace {

using kinematics::Twist;

constexpr double kEndsWithin_m = 0.001;  // 0.4 to 0.7 mm off, as it truly is
constexpr double kFrom_m = 0.005;        // nearer, most stops are good or nearly so
// Steered wheels, farther: see the figures in the header.
constexpr double kSteeredTo_m = 0.03;
constexpr double kSteeredTo_rad = radians(0.3);
constexpr double kTopSpeed_mps = 0.15;
// The drive takes on a twist within part of the step, so that it is not behind the window's count.
constexpr double kAccelShare = 0.8;
constexpr double kGoodShare = 0.5;
constexpr double kRounding_s = 1e-9;
constexpr double kOutside = 1.01;  // of the reach: it may begin at its very edge

plant::VehicleType gentle(plant::VehicleType type) {
    type.max_accel_mps2 *= kAccelShare;
    type.max_turn_accel_radps2 *= kAccelShare;
    return type;
}

control::DynamicWindowOptions options_for(const control::AdjustmentLimits& limits) {
    control::DynamicWindowOptions options;
    options.tolerance_m = kGoodShare * limits.good_m;
    options.tolerance_rad = kGoodShare * limits.good_rad;
    options.top_speed_mps = kTopSpeed_mps;
    return options;
}

}  // namespace

bool WindowApproach::helps(const plant::VehicleType& type, const Pose2& body_from_target,
                           const control::AdjustmentLimits& limits, double tick_s) {
    const double from_m = std::max(kFrom_m, kTopSpeed_mps * tick_s);
    const double off_m = norm(body_from_target.position());
    const bool steered = std::any_of(type.wheels.begin(), type.wheels.end(),
                                     [](const plant::Wheel& wheel) { return wheel.steered; });
    return tick_s <= kLongest_s && control::moves_sideways(type) &&
           limits.good_m >= kEndsWithin_m && off_m > from_m &&
           off_m <= (steered ? kSteeredTo_m : limits.reach_m) &&
           std::abs(body_from_target.heading_rad) <= (steered ? kSteeredTo_rad : limits.reach_rad);
}

WindowApproach::WindowApproach(Drive& motion, const Pose2& hall_from_target,
                               const control::AdjustmentLimits& limits,
                               const std::vector<control::Scan>* seen)
    : motion_(motion),
      hall_from_target_(hall_from_target),
      limits_(limits),
      window_(gentle(motion.type()), options_for(limits)),
      seen_(seen) {}

void WindowApproach::gather_things() {
    things_.clear();
    if (seen_ == nullptr) return;
    for (const control::Scan& scan : *seen_) {
        control::visit_ends(scan, scan.body_from_sensor,
                            [&](geometry::Point2 end) { things_.push_back(end); });
    }
}

WindowApproach::State WindowApproach::step(double dt_s) {
    const double own_s = dt_s * motion_.time_factor();
    // Paused, or with something in its way, it waits.
    if (!motion_.standing()) driven_s_ += own_s;
    until_step_s_ -= own_s;
    if (until_step_s_ > kRounding_s) return State::kDriving;
    const double step_s = std::max(kStep_s, own_s);
    until_step_s_ = std::max(0.0, until_step_s_ + step_s);
    if (driven_s_ > kPatience_s) return end(State::kTimedOut);

    const Pose2 left = inverse(motion_.believed_pose()) * hall_from_target_;
    if (norm(left.position()) > kOutside * limits_.reach_m ||
        std::abs(left.heading_rad) > kOutside * limits_.reach_rad) {
        return end(State::kStopped);
    }
    gather_things();
    const auto command =
        window_.step({asked_, motion_.believed_pose(), hall_from_target_, step_s, things_});
    if (command.state == control::WindowCommand::State::kReached) return end(State::kReached);
    if (command.state == control::WindowCommand::State::kBlocked) return end(State::kStopped);
    asked_ = command.twist;
    const double factor = motion_.time_factor();
    motion_.steer({factor * asked_.vx_mps, factor * asked_.vy_mps, factor * asked_.turn_radps});
    return State::kDriving;
}

WindowApproach::State WindowApproach::end(State state) {
    motion_.steer({});
    return state;
}

}  // namespace pulseline::onboard
