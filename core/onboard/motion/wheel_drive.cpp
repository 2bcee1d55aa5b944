#include "core/onboard/motion/wheel_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/control/path_tracker.hpp"

namespace pulseline::onboard {
namespace {

using kinematics::Segment;
using kinematics::Twist;
using kinematics::WheelMotion;

constexpr double kNoWay = 1e-9;
constexpr double kRounding_s = 1e-9;  // so little less of time is a whole cycle
constexpr double kStartShare = 0.05;  // of the speed for which the standing wheels are steered
constexpr int kLooks = 100;           // ahead on a run, at the wheels' directions
constexpr double kFarAhead = 1e9;
constexpr double kFeedback_rad = radians(2);  // steering that is left to the tracker
constexpr double kBrakeAhead = 0.02;
constexpr double kFlip_rad = 0.35;       // steering does not follow such a change while driving
constexpr double kFlipSpeed_mps = 0.01;  // slower wheels may point anywhere
constexpr double kSettleGain_per_s = 1.5;
constexpr double kSettle_s = 0.15;  // dead time and velocity loops, at least
constexpr double kThere_m = 1e-4;
constexpr double kThere_rad = 2e-5;
// Behind its reference by more than this a vehicle drives at its top speed and catches up by
// nothing but a reference that waits; it comes near by 1/e over the second way. Wheels that follow
// their position loops stay below the first.
constexpr double kBehind_m = 0.01;
constexpr double kCatchUp_m = 0.2;
constexpr double kLeastPace = 0.5;
constexpr double kPatience_s = 3;          // then the brake takes what is left
constexpr double kNewDirection_rad = 0.2;  // steered so by twists, it first stands and steers

}  // namespace

WheelDrive::WheelDrive(plant::VehicleType type, Wheels& wheels, const Pose2& believed,
                       double time_factor)
    : type_(std::move(type)),
      wheels_(wheels),
      time_factor_(time_factor),
      cycle_s_(type_.control.cycle_s),
      odometry_(type_),
      reference_(type_, 1),
      believed_(believed),
      goal_(believed),
      wanted_(type_.wheels.size()) {}

void WheelDrive::append(const Segment& segment, double max_speed_mps) {
    reference_.append(segment, max_speed_mps / time_factor_);
    if (phase_ != Phase::kDriving) return;
    steerable_ = kFarAhead;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        steerable_ = std::min(steerable_, steerable_way(i, wanted_[i].angle_rad));
    }
}

void WheelDrive::correct(std::span<const Segment> moves) {
    assert(idle());
    for (const Segment& move : moves) reference_.append_fine(move);
}

void WheelDrive::steer(const Twist& twist) {
    const double share = 1 / time_factor_;
    const Twist own{share * twist.vx_mps, share * twist.vy_mps, share * twist.turn_radps};
    reference_.steer(believed_, own);
    if (phase_ == Phase::kBraked || own == Twist{}) return;
    const auto wheels = kinematics::wheels_of(type_, own, wheels_.present());
    assert(wheels);
    for (std::size_t i = 0; wheels && i < wanted_.size(); ++i) {
        const double change_rad = std::abs((*wheels)[i].angle_rad - wanted_[i].angle_rad);
        must_steer_ |= type_.wheels[i].steered && change_rad > kNewDirection_rad;
    }
}

void WheelDrive::set_believed(const Pose2& pose) {
    if (reference_.steered()) {
        const Pose2 by = pose * inverse(believed_);
        reference_.shift(by);
        goal_ = by * goal_;
        for (Pose2& due : due_) due = by * due;
    }
    believed_ = pose;
}

void WheelDrive::slow_to(double share) {
    speed_share_ = share;
    reference_.slow_to(share);
}

void WheelDrive::clear() {
    assert(standing());
    reference_.clear();
    phase_ = Phase::kBraked;
}

void WheelDrive::acknowledge() {
    if (wheels_.fault() || wheels_.lost()) return;
    cause_.reset();
    slipping_s_ = 0;
}

Twist WheelDrive::twist() const {
    const Twist& own = told_.twist;
    return {time_factor_ * own.vx_mps, time_factor_ * own.vy_mps, time_factor_ * own.turn_radps};
}

std::vector<WheelMotion> WheelDrive::wheels() const {
    std::vector<WheelMotion> wheels = wheels_.measured();
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        if (!type_.wheels[i].driven) {
            wheels[i].speed_mps =
                kinematics::rolling_speed(type_, type_.wheels[i], wheels[i].angle_rad, told_.twist);
        }
        wheels[i].speed_mps *= time_factor_;
    }
    return wheels;
}

void WheelDrive::step(double dt_s) {
    pending_s_ += dt_s * time_factor_;
    for (; pending_s_ >= cycle_s_ - kRounding_s; pending_s_ -= cycle_s_) cycle();
}

void WheelDrive::cycle() {
    in_phase_s_ += cycle_s_;
    if (wheels_.lost()) lose_machine();
    if (!cause_) {
        if (auto wheel = wheels_.fault()) stop_for({stop_causes::kWheelFault, {{"wheel", *wheel}}});
    }
    const bool stays = held_ || cause_ || speed_share_ == 0;
    switch (phase_) {
        case Phase::kBraked:
            if (!reference_.empty() && !stays) begin();
            return;
        case Phase::kSteering:
            return steer_standing();
        case Phase::kDriving:
            stays || must_steer_ ? reference_.hold() : reference_.release();
            return drive();
        case Phase::kSettling:
            return settle();
    }
}

/// The machine brakes by itself. Had the reference gone on meanwhile, the machine would be told to
/// follow it as soon as it is heard again.
void WheelDrive::lose_machine() {
    stop_for({stop_causes::kMachineSilent, {}});
    if (phase_ == Phase::kBraked) return;
    reference_.stand();
    come_to_rest();
}

/// Steers the standing wheels for the first of the way, feedback included.
void WheelDrive::begin() {
    goal_ = reference_.pose();
    due_.assign(static_cast<std::size_t>(wheels_.dead_cycles()), goal_);
    watch_path();
    if (cause_) return;
    const Twist twist =
        control::track(type_, {goal_, reference_.twist_at_share(kStartShare)}, believed_);
    const auto wanted = kinematics::wheels_of(type_, twist, wheels_.present());
    wanted_ = wanted ? *wanted : wheels_.present();
    choose_steering(wheels_.present());
    for (WheelMotion& wheel : wanted_) wheel.speed_mps = 0;
    must_steer_ = false;
    phase_ = Phase::kSteering;
    in_phase_s_ = 0;
    steer_standing();
}

/// Of a wheel's two directions the one with which it can be driven farther, or else the nearer.
void WheelDrive::choose_steering(const std::vector<WheelMotion>& present) {
    steerable_ = kFarAhead;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        if (!type_.wheels[i].steered) continue;
        double& angle_rad = wanted_[i].angle_rad;
        const double other_rad = angle_rad > 0 ? angle_rad - kPi : angle_rad + kPi;
        double way = steerable_way(i, angle_rad);
        const double other_way = steerable_way(i, other_rad);
        const double nearer =
            std::abs(other_rad - present[i].angle_rad) - std::abs(angle_rad - present[i].angle_rad);
        if (other_way > way || (other_way == way && nearer < 0)) {
            angle_rad = other_rad;
            way = other_way;
        }
        steerable_ = std::min(steerable_, way);
    }
}

/// Way on the present run until a wheel that now stands at `angle_rad` reaches its steering limit.
double WheelDrive::steerable_way(std::size_t wheel, double angle_rad) const {
    const double limit_rad = kinematics::kSteeringLimit_rad - kFeedback_rad;
    if (reference_.empty() || !type_.wheels[wheel].steered) return kFarAhead;
    if (std::abs(angle_rad) > limit_rad) return 0;
    const auto place = type_.wheels[wheel].position;
    // Not quite to the end, where the next run begins.
    const double step = (1 - 1e-9) * reference_.run_ahead() / kLooks;
    for (int i = 0; i <= kLooks; ++i) {
        const Twist twist = reference_.twist_ahead(i * step);
        const double vx = twist.vx_mps - twist.turn_radps * place.y_m;
        const double vy = twist.vy_mps + twist.turn_radps * place.x_m;
        if (std::hypot(vx, vy) < kNoWay) continue;
        const double change = wrap(std::atan2(vy, vx) - angle_rad);
        angle_rad += change - kPi * std::round(change / kPi);  // or rolling backwards
        if (std::abs(angle_rad) > limit_rad) return std::max(0, i - 1) * step;
    }
    return kFarAhead;
}

void WheelDrive::steer_standing() {
    if (must_steer_ && !reference_.empty()) return begin();
    if (wheels_.aligned(wanted_, limits_.aligned_rad)) {
        phase_ = Phase::kDriving;
        return;
    }
    wheels_.steer(wanted_);
}

/// Share of the time for the reference: codes that put the vehicle back add up on a long way.
double WheelDrive::reference_pace() const {
    const Twist twist = reference_.twist();
    const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
    if (speed <= kNoWay) return 1;
    const Pose2 left = inverse(believed_) * due_.front();
    const double behind_m = (left.x_m * twist.vx_mps + left.y_m * twist.vy_mps) / speed;
    if (behind_m <= kBehind_m) return 1;
    return std::max(kLeastPace, 1 - (behind_m - kBehind_m) / kCatchUp_m);
}

void WheelDrive::drive() {
    due_.push_back(goal_);
    due_.pop_front();
    for (const auto& passed : reference_.step(reference_pace() * cycle_s_)) {
        goal_ = passed.to;
        steerable_ -= passed.way;
    }
    must_steer_ |= steerable_ <= reference_.braking_way() + kBrakeAhead;
    if (reference_.standing()) {
        phase_ = Phase::kSettling;
        in_phase_s_ = 0;
        return settle();
    }
    last_ = control::track(type_, {due_.front(), reference_.twist()}, believed_);
    follow(last_);
}

/// The position loops take up what is left of the motion, and the tracker what is left along it:
/// across it no wheel could go without being steered.
void WheelDrive::settle() {
    const Pose2 left = inverse(believed_) * goal_;
    const double speed = std::hypot(last_.vx_mps, last_.vy_mps);
    const double turn = std::abs(last_.turn_radps);
    Twist twist;
    if (speed > kNoWay) {
        const double along = (left.x_m * last_.vx_mps + left.y_m * last_.vy_mps) / speed;
        const double share = kSettleGain_per_s * along / speed;
        twist = {share * last_.vx_mps, share * last_.vy_mps, 0};
    } else if (turn > kNoWay) {
        twist.turn_radps = kSettleGain_per_s * left.heading_rad;
    }
    follow(kinematics::within_limits(type_, twist));
    const bool there = std::hypot(twist.vx_mps, twist.vy_mps) < kSettleGain_per_s * kThere_m &&
                       std::abs(twist.turn_radps) < kSettleGain_per_s * kThere_rad;
    const bool rests = there && in_phase_s_ >= kSettle_s && wheels_.settled();
    if (rests || in_phase_s_ >= kPatience_s) come_to_rest();
}

/// Wheels, floor and odometry of one cycle.
void WheelDrive::follow(const Twist& twist) {
    const auto wanted = kinematics::wheels_of(type_, twist, wheels_.present());
    // A differential vehicle is never asked to go sideways, so there is always an answer.
    if (wanted) wanted_ = *wanted;
    const auto& present = wheels_.present();
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        const double jump = wanted_[i].angle_rad - present[i].angle_rad;
        // Only feedback can ask for it: choose_steering() has looked ahead.
        if (std::abs(jump) < kFlip_rad || std::abs(wanted_[i].speed_mps) < kFlipSpeed_mps) continue;
        wanted_[i] = {present[i].angle_rad, wanted_[i].speed_mps * std::cos(jump)};
        must_steer_ = true;
    }
    wheels_.roll(wanted_);
    told_ = odometry_.body_of(wheels_.measured());
    believed_ = kinematics::moved(believed_, told_.twist, cycle_s_);
    watch_path();
    watch_slip();
}

void WheelDrive::watch_path() {
    const double off_m = distance(goal_.position(), believed_.position());
    const double off_rad = std::abs(wrap(goal_.heading_rad - believed_.heading_rad));
    if (off_m > limits_.path_m || off_rad > limits_.path_rad) {
        stop_for({stop_causes::kOffPath, {{"distance_m", off_m}}});
    }
}

void WheelDrive::watch_slip() {
    double share = wheels_.slip_share().value_or(0);
    const double pace = std::hypot(told_.twist.vx_mps, told_.twist.vy_mps);
    if (pace > limits_.slip_speed_mps) share = std::max(share, told_.slip_mps / pace);
    slipping_s_ = share > limits_.slip ? slipping_s_ + cycle_s_ : 0;
    if (slipping_s_ <= limits_.slip_time_s) return;
    if (auto wheel = wheels_.lagging()) {
        wheels_.switch_off(*wheel);
        return stop_for({stop_causes::kWheelFault, {{"wheel", *wheel}}});
    }
    stop_for({stop_causes::kSlip, {{"share", share}}});
}

/// The first cause stays: what follows comes of it.
void WheelDrive::stop_for(Reason cause) {
    if (!cause_) cause_ = std::move(cause);
}

void WheelDrive::come_to_rest() {
    wheels_.brake();
    ++rests_;
    told_ = {};
    last_ = {};
    slipping_s_ = 0;
    phase_ = Phase::kBraked;
    in_phase_s_ = 0;
}

}  // namespace pulseline::onboard
