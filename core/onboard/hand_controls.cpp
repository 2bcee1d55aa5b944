#include "core/onboard/hand_controls.hpp"

#include <algorithm>

namespace pulseline::onboard {
namespace {

/// By how much two clocks may drift apart: a quartz that is ten times worse than usual.
constexpr double kDrift = 1e-3;

tl::unexpected<Error> in_other_hands(const HandControl& holder) {
    return fail(Errc::kConflict, "in_other_hands",
                holder.person.empty()
                    ? "Somebody beside the vehicle has it in hand. They have to give it back first."
                    : holder.person + " has the vehicle in hand, and has to give it back first.",
                {}, {{"person", holder.person}});
}

}  // namespace

Status HandControls::take(const HandControl& control, double now_s) {
    const bool is_mine = holder_ && holder_->id == control.id;
    const bool is_free = !executor_.in_hand() || !holder_ || !is_there_;
    if (!is_mine && !is_free && now_s - heard_s_ < kSilent_s) return in_other_hands(*holder_);
    executor_.take_by_hand();
    holder_ = control;
    is_there_ = true;
    heard_s_ = now_s;
    quickest_s_.reset();
    return {};
}

Status HandControls::is_holder(const std::string& control) const {
    if (!executor_.in_hand() || !holder_) {
        return fail(Errc::kConflict, "not_in_hand", "Take the vehicle by hand first.");
    }
    if (holder_->id != control) return in_other_hands(*holder_);
    return {};
}

Status HandControls::drive(const std::string& control, const kinematics::Twist& wanted,
                           std::optional<double> sent_s, double now_s) {
    if (Status status = is_holder(control); !status) return status;
    heard(control, now_s);
    if (sent_s) {
        const double took_s = now_s - *sent_s;
        const double drifted_s = kDrift * (now_s - quickest_at_s_);
        quickest_s_ = std::min(took_s, quickest_s_.value_or(took_s) + drifted_s);
        quickest_at_s_ = now_s;
        if (const double late_s = took_s - *quickest_s_; late_s > kLate_s) {
            executor_.brake_by_hand();  // to stop it is never too late
            return fail(Errc::kConflict, "too_late",
                        "The command was on its way for too long, and is not done any more.", {},
                        {{"late_s", late_s}});
        }
    }
    return executor_.drive_by_hand(wanted);
}

Status HandControls::give_back(const std::string& control) {
    if (Status status = is_holder(control); !status) return status;
    if (Status status = executor_.give_back(); !status) return status;
    holder_.reset();
    return {};
}

void HandControls::heard(const std::string& control, double now_s) {
    if (holder_ && holder_->id == control) heard_s_ = now_s;
}

void HandControls::left(const std::string& control) {
    if (!is_holder(control)) return;
    is_there_ = false;
    executor_.brake_by_hand();  // at once, not when it is missed
}

}  // namespace pulseline::onboard
