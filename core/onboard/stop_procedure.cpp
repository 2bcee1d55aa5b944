#include "core/onboard/stop_procedure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/onboard/stop_search.hpp"

namespace pulseline::onboard {
namespace {

constexpr int kBlindPasses = 4;
constexpr int kApproaches = 2;
constexpr double kSettle_s = 0.4;      // until the chassis no longer swings in the image
constexpr double kLookEvery_m = 0.02;  // a third of a code: none is passed unseen
// How far off it is brought back from, wherever in the picture the code lies: beyond that place the
// server takes it to be elsewhere, and a person errs by half that heading.
constexpr double kSeen_m = 0.3;
constexpr double kSeen_rad = radians(10.0);
constexpr double kMargin = 1.02;  // moves end a little off

bool inside(const vda5050::StopMeasurement& measured, const vda5050::StopTarget& target) {
    return std::abs(measured.pose.x_m - target.target.x_m) <= target.tolerance_x_m &&
           std::abs(measured.pose.y_m - target.target.y_m) <= target.tolerance_y_m &&
           std::abs(wrap(measured.pose.heading_rad - target.target.heading_rad)) <=
               target.tolerance_heading_rad;
}

/// Adjusting ends well inside the tolerance, where one is stated: what is left must not be decided
/// by the next look.
control::AdjustmentLimits limits_for(control::AdjustmentLimits limits,
                                     const vda5050::StopTarget& target) {
    constexpr double kShare = 0.4;
    const auto tighten = [](double& good, double tolerance) {
        if (tolerance > 0) good = std::min(good, kShare * tolerance);
    };
    tighten(limits.good_m, target.tolerance_x_m);
    tighten(limits.good_m, target.tolerance_y_m);
    tighten(limits.good_rad, target.tolerance_heading_rad);
    limits.accept_m = std::min(target.tolerance_x_m, target.tolerance_y_m);
    limits.accept_rad = target.tolerance_heading_rad;
    return limits;
}

}  // namespace

StopProcedure::StopProcedure(Drive& motion, StopSensing& sensing,
                             const control::AdjustmentLimits& limits,
                             control::MotionCompensation compensation)
    : motion_(motion),
      sensing_(sensing),
      limits_(limits),
      compensation_(std::move(compensation)),
      adjustment_(motion.type(), limits) {}

void StopProcedure::start(const vda5050::StopTarget& target, bool correct) {
    // What is measured where an adjustment has ended is still of the drive before that one.
    const bool adjusted = !correct && last_ && target.station_id == target_.station_id &&
                          motion_.believed_pose() == last_->pose;
    if (!adjusted) {
        arrived_.reset();
        moved_unseen_ = false;
    }
    target_ = target;
    correct_ = correct;
    running_ = true;
    aborting_ = false;
    target_limits_ = limits_for(limits_, target);
    adjustment_ = control::Adjustment(motion_.type(), target_limits_);
    approach_.reset();
    late_ = on_the_way_ = false;
    approaches_ = 0;
    blind_passes_ = 0;
    to_search_.reset();
    last_.reset();
    driven_.clear();
    settling_s_ = kSettle_s / motion_.time_factor();
}

void StopProcedure::abort() {
    if (!running_) return;
    aborting_ = true;
    motion_.hold();
}

std::optional<StopProcedure::Outcome> StopProcedure::step(double dt_s) {
    if (!running_) return std::nullopt;
    tick_s_ = dt_s * motion_.time_factor();
    if (aborting_) {
        if (!motion_.standing()) return std::nullopt;
        motion_.clear();
        return finish(false, "cancelled");
    }
    if (!motion_.idle() || approach_) {
        if (const auto cause = motion_.stop_cause(); cause && motion_.standing()) {
            motion_.clear();
            return finish(false, "drive_stopped: " + cause->code);
        }
        settling_s_ = kSettle_s / motion_.time_factor();
        if (approach_) drive_approach(dt_s);
        return std::nullopt;
    }
    settling_s_ -= dt_s;
    if (settling_s_ > 0) return std::nullopt;
    return take_measurement();
}

void StopProcedure::drive_approach(double dt_s) {
    if (!last_) look_on_the_way();
    const auto state = approach_->step(dt_s);
    if (state == WindowApproach::State::kDriving) return;
    late_ = state == WindowApproach::State::kTimedOut;
    approach_.reset();
}

/// Blind where it began, it sees the codes come into view. It creeps: no image is smeared.
void StopProcedure::look_on_the_way() {
    const double left_m = distance(motion_.believed_pose().position(), target_.target.position());
    if (on_the_way_ || looked_at_m_ - left_m < kLookEvery_m) return;
    looked_at_m_ = left_m;
    const auto measured = sensing_.measure(target_);
    if (!measured) return;
    on_the_way_ = true;
    motion_.set_believed(measured->pose);
}

std::optional<StopProcedure::Outcome> StopProcedure::take_measurement() {
    const auto measured = sensing_.measure(target_);
    if (!measured) {
        // Without pictures it would look about in vain.
        const bool can_look = measured.error().code != Errc::kUnavailable;
        const bool goes_on =
            can_look && correct_ && !last_ && (look_where_it_should_be() || search());
        if (goes_on) {
            moved_unseen_ = true;
            return std::nullopt;
        }
        return finish(false, measured.error().reason.code + ": " + measured.error().what);
    }
    learn(*measured);
    // Only a look before any move shows where the drive itself had ended.
    if (!arrived_ && !moved_unseen_) arrived_ = measured->pose;
    if (!last_) reach_from(inverse(measured->pose) * target_.target);
    last_ = *measured;
    last_->arrived = arrived_;
    motion_.set_believed(measured->pose);
    if (!correct_) return finish(true, {});
    const Pose2 off = inverse(measured->pose) * target_.target;
    if (adjustment_.is_good(off)) return finish(true, {});
    if (!late_ && begin_approach(off)) return std::nullopt;
    const Status begun = late_ ? too_late(off) : begin_pass(adjustment_, off);
    if (begun) return std::nullopt;
    if (adjustment_.is_in_reach(off) && inside(*measured, target_)) return finish(true, {});
    return finish(false, begun.error().reason.code + ": " + begun.error().what);
}

/// It may know better where it is than when it drove here: a person has said so since.
bool StopProcedure::look_where_it_should_be() {
    const Pose2 off = inverse(motion_.believed_pose()) * target_.target;
    if (to_search_ || blind_passes_ == kBlindPasses || adjustment_.is_good(off)) return false;
    ++blind_passes_;
    if (begin_approach(off)) return true;
    control::Adjustment blind(motion_.type(), limits_);
    return begin_pass(blind, off).has_value();
}

bool StopProcedure::search() {
    if (!to_search_) {
        to_search_ = search_places(motion_.type(), target_, limits_.reach_m);
        std::ranges::reverse(*to_search_);
    }
    while (!to_search_->empty()) {
        const Pose2 off = inverse(motion_.believed_pose()) * to_search_->back();
        to_search_->pop_back();
        control::Adjustment blind(motion_.type(), limits_);
        if (!blind.is_good(off) && begin_pass(blind, off)) return true;
    }
    return false;
}

/// It stands beside the floor that it holds: the way to the target is the only one that leads onto
/// it, and no way may lead farther off.
void StopProcedure::reach_from(const Pose2& body_from_target) {
    const double off_m = norm(body_from_target.position());
    const double off_rad = std::abs(body_from_target.heading_rad);
    if (off_m > kSeen_m || off_rad > kSeen_rad) return;
    target_limits_.reach_m = std::max(target_limits_.reach_m, kMargin * off_m);
    target_limits_.reach_rad = std::max(target_limits_.reach_rad, kMargin * off_rad);
    adjustment_ = control::Adjustment(motion_.type(), target_limits_);
}

/// An approach that ended elsewhere than it believed is not tried again for ever.
bool StopProcedure::begin_approach(const Pose2& body_from_target) {
    if (approaches_ == kApproaches ||
        !WindowApproach::helps(motion_.type(), body_from_target, target_limits_, tick_s_)) {
        return false;
    }
    ++approaches_;
    looked_at_m_ = norm(body_from_target.position());
    settling_s_ = kSettle_s / motion_.time_factor();
    approach_.emplace(motion_, target_.target, target_limits_, seen_);
    return true;
}

Status StopProcedure::too_late(const Pose2& body_from_target) const {
    const double left_m = norm(body_from_target.position());
    const double left_rad = std::abs(body_from_target.heading_rad);
    char text[96];
    std::snprintf(text, sizeof text, "%.1f mm and %.3f deg left when the time was up", 1e3 * left_m,
                  degrees(left_rad));
    return fail(Errc::kTimeout, "out_of_time", text, {},
                {{"left_m", left_m}, {"left_rad", left_rad}});
}

Status StopProcedure::begin_pass(control::Adjustment& loop, const Pose2& body_from_target) {
    const auto moves = loop.next(body_from_target, compensation_);
    if (!moves) return fail(moves.error());
    settling_s_ = kSettle_s / motion_.time_factor();
    driven_ = control::moves_of(*moves);
    motion_.correct(control::placed(motion_.believed_pose(), *moves));
    return {};
}

/// A pass that began from a measured pose shows how the vehicle moves.
void StopProcedure::learn(const vda5050::StopMeasurement& after) {
    const auto driven = std::exchange(driven_, {});
    if (!last_ || driven.empty()) return;
    // Refused is only what is no number; then there is nothing to learn.
    (void)compensation_.learn({driven, inverse(last_->pose) * after.pose,
                               std::hypot(last_->sigma_xy_m, after.sigma_xy_m),
                               std::hypot(last_->sigma_heading_rad, after.sigma_heading_rad)});
}

StopProcedure::Outcome StopProcedure::finish(bool succeeded, std::string why_not) {
    running_ = false;
    approach_.reset();
    return {succeeded, last_, std::move(why_not)};
}

}  // namespace pulseline::onboard
