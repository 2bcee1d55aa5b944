#include "core/onboard/going_round.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

namespace pulseline::onboard {
namespace {

// What walks past should not make it swerve.
constexpr double kPatience_s = 2;
constexpr double kAgain_s = 3;
// Of the clearance that a detour is planned with; the rest is the scanners' noise.
constexpr double kStillClear_m = 0.12;
// Planning in vain costs a tenth of a second of processor, however fast the vehicle's time runs.
constexpr double kAgainReal_s = 2;

std::string words_of(const planning::Detour& detour) {
    char words[160];
    std::snprintf(words, sizeof words,
                  "going round an obstacle on a way of %.1f m, up to %.2f m to the %s of its line",
                  detour.length_m, std::abs(detour.beside_m),
                  detour.beside_m >= 0 ? "left" : "right");
    return words;
}

}  // namespace

void GoingRound::step(double dt_s) {
    const bool going = executor_.way_ahead().going_round();
    look_out_.keep_room(!executor_.way_ahead().stretch(false).empty());
    if (!going && !look_out_.barred()) {
        seen_.forget();
        planned_edges_.reset();
    } else {
        remember();
    }
    if (!going && meets_) look_out_.bar(meets_ = false);
    if (!look_out_.barred()) {
        barred_for_s_ = 0;
        executor_.ask_for_base(false);
        return tell(going ? going_ : "", "");
    }
    if (!going) tell("", why_not_);
    const double own_s = dt_s * drive_.time_factor();
    barred_for_s_ += own_s;
    since_plan_s_ += own_s;
    since_plan_real_s_ += dt_s;
    const double patience_s = meets_ ? 0 : kPatience_s;
    if (barred_for_s_ >= patience_s && executor_.may_go_round() && due()) plan();
}

void GoingRound::remember() {
    if (looks_ == look_out_.looks()) return;
    looks_ = look_out_.looks();
    for (const auto& scan : look_out_.scans()) seen_.take(scan, drive_.believed_pose());
    watch_detour();
}

/// Scanners see all of a thing while the front goes by, and the fields little of what a long
/// vehicle has behind its front.
void GoingRound::watch_detour() {
    if (!executor_.way_ahead().going_round()) return;
    meets_ =
        !planning::keeps_clear(type_, loaded_, drive_.believed_pose(),
                               executor_.way_ahead().detour_ahead(), seen_.points(), kStillClear_m);
    look_out_.bar(meets_);
}

bool GoingRound::due() const {
    if (!planned_edges_ || *planned_edges_ != executor_.way_ahead().stretch(false).size()) {
        return true;
    }
    return since_plan_s_ >= kAgain_s && since_plan_real_s_ >= kAgainReal_s;
}

Result<planning::Detour> GoingRound::plan(const std::vector<planning::DetourEdge>& stretch) const {
    return planning::plan_detour(
        {&type_, loaded_, drive_.believed_pose(), stretch, seen_.points()});
}

void GoingRound::plan() {
    const auto base = executor_.way_ahead().stretch(false);
    since_plan_s_ = since_plan_real_s_ = 0;
    planned_edges_ = base.size();
    if (const auto detour = plan(base)) {
        executor_.go_round(*detour);
        executor_.ask_for_base(false);
        look_out_.bar(meets_ = false);
        planned_edges_.reset();
        barred_for_s_ = 0;
        return tell(words_of(*detour), "");
    } else {
        const auto with_horizon = executor_.way_ahead().stretch(true);
        const bool asks = with_horizon.size() > base.size() && plan(with_horizon);
        executor_.ask_for_base(asks);
        tell(going_, asks ? "its base is too short; it asks for more" : detour.error().what);
    }
}

void GoingRound::tell(std::string going, std::string why_not) {
    changed_ |= going != going_ || why_not != why_not_;
    going_ = std::move(going);
    why_not_ = std::move(why_not);
}

bool GoingRound::take_changed() { return std::exchange(changed_, false); }

void GoingRound::write_state(vda5050::StateMessage& state) const {
    if (!why_not_.empty()) {
        for (auto& error : state.errors) {
            if (error.type == LookOut::kObstacle) {
                error.description += "; it does not go round it: " + why_not_;
            }
        }
    }
    if (!going_.empty()) state.errors.push_back({"going_round", false, going_, {}});
}

}  // namespace pulseline::onboard
