#include "core/simulation/machine/servo_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/control/path_tracker.hpp"

namespace pulseline::simulation {
namespace {

using kinematics::Segment;
using kinematics::Twist;
using kinematics::WheelMotion;

constexpr double kNoWay = 1e-9;
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
constexpr double kPatience_s = 3;  // then the brake takes what is left
constexpr double kScrubTurn_rad = 0.1;
constexpr double kNewDirection_rad = 0.2;  // steered so by twists, it first stands and steers

}  // namespace

ServoDrive::ServoDrive(plant::VehicleType type, const Pose2& true_pose, std::uint64_t seed,
                       double time_factor, double load_kg, const localisation::ErrorBudget& errors)
    : type_(std::move(type)),
      time_factor_(time_factor),
      errors_(errors.drive),
      random_(seed),
      wheels_(type_, load_kg, errors.drive, random_),
      contact_(type_, load_kg, errors.drive, random_),
      measuring_(type_, errors.slip_sensor, random_),
      odometry_(type_),
      reference_(type_, 1),
      true_(true_pose),
      believed_(true_pose),
      goal_(true_pose),
      wanted_(type_.wheels.size()),
      accel_mps2_(type_.wheels.size()),
      grade_n_(type_.wheels.size()) {}

void ServoDrive::append(const Segment& segment, double max_speed_mps) {
    reference_.append(segment, max_speed_mps / time_factor_);
    if (phase_ != Phase::kDriving) return;
    steerable_ = kFarAhead;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        steerable_ = std::min(steerable_, steerable_way(i, wanted_[i].angle_rad));
    }
}

void ServoDrive::correct(std::span<const Segment> moves) {
    assert(idle());
    for (const Segment& move : moves) reference_.append_fine(move);
}

void ServoDrive::steer(const Twist& twist) {
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

void ServoDrive::set_believed(const Pose2& pose) {
    if (reference_.steered()) {
        const Pose2 by = pose * inverse(believed_);
        reference_.shift(by);
        goal_ = by * goal_;
        for (Pose2& due : due_) due = by * due;
    }
    believed_ = pose;
}

void ServoDrive::slow_to(double share) {
    speed_share_ = share;
    reference_.slow_to(share);
}

void ServoDrive::clear() {
    assert(standing());
    reference_.clear();
    phase_ = Phase::kBraked;
}

void ServoDrive::acknowledge() {
    if (wheels_.fault()) return;
    cause_.reset();
    slipping_s_ = 0;
}

Twist ServoDrive::twist() const {
    const Twist& own = told_.twist;
    return {time_factor_ * own.vx_mps, time_factor_ * own.vy_mps, time_factor_ * own.turn_radps};
}

std::vector<WheelMotion> ServoDrive::wheels() const {
    std::vector<WheelMotion> wheels = wheels_.measured();
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        if (!type_.wheels[i].driven) {
            wheels[i].speed_mps =
                rolling_speed(type_, type_.wheels[i], wheels[i].angle_rad, told_.twist);
        }
        wheels[i].speed_mps *= time_factor_;
    }
    return wheels;
}

void ServoDrive::step(double dt_s) {
    pending_s_ += dt_s * time_factor_;
    for (; pending_s_ >= ServoAxis::kCycle_s - ServoAxis::kRounding_s;
         pending_s_ -= ServoAxis::kCycle_s)
        cycle();
}

void ServoDrive::cycle() {
    in_phase_s_ += ServoAxis::kCycle_s;
    if (!cause_) {
        if (auto wheel = wheels_.fault())
            stop_for({onboard::stop_causes::kWheelFault, {{"wheel", *wheel}}});
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

/// Steers the standing wheels for the first of the way, feedback included.
void ServoDrive::begin() {
    goal_ = reference_.pose();
    due_.assign(WheelSet::kDeadCycles, goal_);
    watch_path();
    if (cause_) return;
    const Twist twist =
        control::track(type_, {goal_, reference_.twist_at_share(kStartShare)}, believed_);
    const auto wanted = kinematics::wheels_of(type_, twist, wheels_.present());
    wanted_ = wanted ? *wanted : wheels_.present();
    choose_steering(wheels_.present());
    for (WheelMotion& wheel : wanted_) wheel.speed_mps = 0;
    if (!wheels_.aligned(wanted_, kScrubTurn_rad)) {
        true_ = true_ * Pose2{normal(errors_.scrub_m), normal(errors_.scrub_m), 0};
    }
    must_steer_ = false;
    phase_ = Phase::kSteering;
    in_phase_s_ = 0;
    steer_standing();
}

/// Of a wheel's two directions the one with which it can be driven farther, or else the nearer.
void ServoDrive::choose_steering(const std::vector<WheelMotion>& present) {
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
double ServoDrive::steerable_way(std::size_t wheel, double angle_rad) const {
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

void ServoDrive::steer_standing() {
    if (must_steer_ && !reference_.empty()) return begin();
    if (wheels_.aligned(wanted_, limits_.aligned_rad)) {
        phase_ = Phase::kDriving;
        return;
    }
    turn_wheels(wanted_, true);
}

/// Share of the time for the reference: codes that put the vehicle back add up on a long way.
double ServoDrive::reference_pace() const {
    const Twist twist = reference_.twist();
    const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
    if (speed <= kNoWay) return 1;
    const Pose2 left = inverse(believed_) * due_.front();
    const double behind_m = (left.x_m * twist.vx_mps + left.y_m * twist.vy_mps) / speed;
    if (behind_m <= kBehind_m) return 1;
    return std::max(kLeastPace, 1 - (behind_m - kBehind_m) / kCatchUp_m);
}

void ServoDrive::drive() {
    due_.push_back(goal_);
    due_.pop_front();
    for (const auto& passed : reference_.step(reference_pace() * ServoAxis::kCycle_s)) {
        goal_ = passed.to;
        steerable_ -= passed.way;
        if (!passed.on_the_spot) peak_mps_ = std::max(peak_mps_, passed.way / ServoAxis::kCycle_s);
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
void ServoDrive::settle() {
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
void ServoDrive::follow(const Twist& twist) {
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
    turn_wheels(wanted_, false);
    for (std::size_t i = 0; i < accel_mps2_.size(); ++i) accel_mps2_[i] = wheels_.accel_mps2(i);
    true_twist_ =
        contact_.body_twist(wheels_.rolled(), accel_mps2_, true_, ServoAxis::kCycle_s, random_);
    true_ = moved(true_, true_twist_, ServoAxis::kCycle_s);
    told_ = odometry_.body_of(wheels_.measured());
    believed_ = moved(believed_, told_.twist, ServoAxis::kCycle_s);
    watch_path();
    watch_slip();
}

void ServoDrive::turn_wheels(const std::vector<WheelMotion>& wanted, bool standing) {
    if (!standing) contact_.grade_forces(wheels_.rolled(), true_, grade_n_);
    wheels_.cycle(wanted, standing, grade_n_);
}

void ServoDrive::watch_path() {
    const double off_m = distance(goal_.position(), believed_.position());
    const double off_rad = std::abs(wrap(goal_.heading_rad - believed_.heading_rad));
    if (off_m > limits_.path_m || off_rad > limits_.path_rad) {
        stop_for({onboard::stop_causes::kOffPath, {{"distance_m", off_m}}});
    }
}

void ServoDrive::watch_slip() {
    double share = measuring_
                       .slip_share(wheels_.measured(), contact_.rolling(), true_twist_,
                                   ServoAxis::kCycle_s, random_)
                       .value_or(0);
    const double pace = std::hypot(told_.twist.vx_mps, told_.twist.vy_mps);
    if (pace > limits_.slip_speed_mps) share = std::max(share, told_.slip_mps / pace);
    slipping_s_ = share > limits_.slip ? slipping_s_ + ServoAxis::kCycle_s : 0;
    if (slipping_s_ <= limits_.slip_time_s) return;
    if (auto wheel = wheels_.lagging()) {
        wheels_.switch_off(*wheel);
        return stop_for({onboard::stop_causes::kWheelFault, {{"wheel", *wheel}}});
    }
    stop_for({onboard::stop_causes::kSlip, {{"share", share}}});
}

/// The first cause stays: what follows comes of it.
void ServoDrive::stop_for(Reason cause) {
    if (!cause_) cause_ = std::move(cause);
}

/// The brakes fall in, and the chassis sags.
void ServoDrive::come_to_rest() {
    wheels_.brake();
    ++rests_;
    const double share = std::min(1.0, std::exchange(peak_mps_, 0) / type_.max_speed_mps);
    const double settle_m = errors_.fine_m + share * errors_.settle_m;
    const double settle_rad = errors_.fine_rad + share * errors_.settle_rad;
    true_ = true_ * Pose2{normal(settle_m), normal(settle_m), normal(settle_rad)};
    told_ = {};
    last_ = {};
    true_twist_ = {};
    slipping_s_ = 0;
    measuring_.rest();
    phase_ = Phase::kBraked;
    in_phase_s_ = 0;
}

}  // namespace pulseline::simulation
