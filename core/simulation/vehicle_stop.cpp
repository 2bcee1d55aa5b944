#include "core/simulation/vehicle_stop.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace pulseline::simulation {
namespace {

constexpr int kCorrections = 4;
constexpr double kGoodPosition_m = 0.002;
constexpr double kGoodHeading_rad = 0.03 * kPi / 180;
// A correction leaves the released floor by no more than this; beyond it the server must send a
// leg.
constexpr double kReach_m = 0.1;
constexpr double kReach_rad = 1.0 * kPi / 180;
constexpr double kSettle_s = 0.4;  // until the chassis no longer swings in the image

/// Where the target is, seen from the measured body.
Pose2 body_from_target(const fleet::StopMeasurement& measured, const fleet::StopTarget& target) {
    return inverse(measured.pose) * target.target;
}

bool is_good(const Pose2& off) {
    return norm(off.position()) <= kGoodPosition_m && std::abs(off.heading_rad) <= kGoodHeading_rad;
}

bool is_in_reach(const Pose2& off) {
    return norm(off.position()) <= kReach_m && std::abs(off.heading_rad) <= kReach_rad;
}

bool inside(const fleet::StopMeasurement& measured, const fleet::StopTarget& target) {
    return std::abs(measured.pose.x_m - target.target.x_m) <= target.tolerance_x_m &&
           std::abs(measured.pose.y_m - target.target.y_m) <= target.tolerance_y_m &&
           std::abs(wrap(measured.pose.heading_rad - target.target.heading_rad)) <=
               target.tolerance_heading_rad;
}

std::string describe(const Pose2& off) {
    char text[96];
    std::snprintf(text, sizeof text, "%.1f mm and %.3f deg left at best",
                  1e3 * norm(off.position()), degrees(std::abs(off.heading_rad)));
    return text;
}

/// First all wheels in parallel, then a turn on the spot.
std::array<kinematics::Segment, 2> shift_then_turn(const Pose2& from, const Pose2& off) {
    using Kind = kinematics::Segment::Kind;
    kinematics::Segment shift;
    shift.kind = Kind::kStraight;
    shift.start = from;
    shift.end = from * Pose2{off.x_m, off.y_m, 0};
    shift.length_m = norm(off.position());
    shift.direction_rad = std::atan2(off.y_m, off.x_m);
    kinematics::Segment turn;
    turn.kind = Kind::kRotate;
    turn.start = shift.end;
    turn.end = from * off;
    turn.turn_rad = wrap(off.heading_rad);
    return {shift, turn};
}

}  // namespace

void StopProcedure::start(const fleet::StopTarget& target, bool correct) {
    target_ = target;
    correct_ = correct;
    running_ = true;
    aborting_ = false;
    corrections_ = 0;
    last_.reset();
    settling_s_ = kSettle_s / motion_.time_factor();
}

void StopProcedure::abort() {
    if (!running_) return;
    aborting_ = true;
    motion_.hold();
}

std::optional<StopProcedure::Outcome> StopProcedure::step(double dt_s) {
    if (!running_) return std::nullopt;
    if (aborting_) {
        if (!motion_.standing()) return std::nullopt;
        motion_.clear();
        return finish(false, "cancelled");
    }
    if (!motion_.idle()) {
        if (const auto cause = motion_.stop_cause(); cause && motion_.standing()) {
            motion_.clear();
            return finish(false, "drive_stopped: " + cause->code);
        }
        settling_s_ = kSettle_s / motion_.time_factor();
        return std::nullopt;
    }
    settling_s_ -= dt_s;
    if (settling_s_ > 0) return std::nullopt;
    return take_measurement();
}

std::optional<StopProcedure::Outcome> StopProcedure::take_measurement() {
    const auto measured = sensing_.measure(target_);
    if (!measured && correct_ && !last_ && corrections_ < kCorrections) {
        // It may know better where it is than when it drove here: a person has said so since.
        const Pose2 off = inverse(motion_.believed_pose()) * target_.target;
        if (!is_good(off) && is_in_reach(off)) {
            begin_correction(off);
            return std::nullopt;
        }
    }
    if (!measured) {
        return finish(false, measured.error().reason.code + ": " + measured.error().what);
    }
    last_ = *measured;
    motion_.set_believed(measured->pose);
    if (!correct_) return finish(true, {});
    const Pose2 off = body_from_target(*measured, target_);
    if (is_good(off)) return finish(true, {});
    if (!is_in_reach(off)) {
        return finish(false, "too_far_from_target: " + describe(off));
    }
    if (corrections_ == kCorrections) {
        const bool good_enough = inside(*measured, target_);
        return finish(good_enough,
                      good_enough ? std::string{} : "out_of_tolerance: " + describe(off));
    }
    begin_correction(off);
    return std::nullopt;
}

void StopProcedure::begin_correction(const Pose2& off) {
    ++corrections_;
    settling_s_ = kSettle_s / motion_.time_factor();
    motion_.correct(shift_then_turn(motion_.believed_pose(), off));
}

StopProcedure::Outcome StopProcedure::finish(bool succeeded, std::string why_not) {
    running_ = false;
    return {succeeded, last_, std::move(why_not)};
}

}  // namespace pulseline::simulation
