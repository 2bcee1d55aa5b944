#include "core/onboard/executor.hpp"

#include "core/vda5050/actions.hpp"

/// What the executor does in a person's hands.
namespace pulseline::onboard {

void Executor::take_by_hand() {
    if (in_hand_) return;
    in_hand_ = true;
    cancelled_ = true;  // an update would lead on from where it may not stand any more
    changed_ = true;
    abort_actions("taken by hand");
    must_let_go_ = false;
    motion_.acknowledge();  // who takes it stands beside it
    hand_.take();
}

/// Nodes it brakes past still count as passed; then its order is gone.
void Executor::step_in_hand(double dt_s) {
    run_lift();
    if (!way_.empty() || procedure_.running()) {
        motion_.hold();
        motion_.step(dt_s);
        take_traversals();
        waiting_.clear();
        if (procedure_.running()) static_cast<void>(procedure_.step(dt_s));
        if (motion_.standing() && !procedure_.running()) drop_order();
    } else {
        hand_.step(dt_s);
        motion_.step(dt_s);
    }
    finish_cancel();
    finish_pause();
    note_motion();
}

Status Executor::drive_by_hand(const kinematics::Twist& wanted) {
    if (!in_hand_) {
        return fail(Errc::kConflict, "not_in_hand", "Take the vehicle by hand first.");
    }
    if (wanted == kinematics::Twist{}) {
        must_let_go_ = false;
        if (motion_.stop_cause()) motion_.acknowledge();  // who lets go has seen that it stands
        return hand_.command(wanted);
    }
    if (must_let_go_) {
        return fail(Errc::kConflict, "let_go_first",
                    "Somebody has paused the vehicle. Let go, look at it, then press again.");
    }
    if (equipment_ != nullptr && equipment_->holds_vehicle()) {
        return fail(Errc::kConflict, "held",
                    "The vehicle stands on its feet or is plugged in. Raise the feet, stop "
                    "charging.");
    }
    if (equipment_ != nullptr && equipment_->half_transferred()) {
        return fail(Errc::kConflict, "load_half_taken", vda5050::kLoadHalfTakenWords);
    }
    if (const auto cause = motion_.stop_cause()) {
        return fail(
            Errc::kConflict, cause->code,
            "The drive has stopped of itself. Let go, look at what stopped it, then press again.",
            {}, cause->params);
    }
    return hand_.command(wanted);
}

void Executor::brake_by_hand() {
    if (in_hand_) static_cast<void>(hand_.command({}));
}

Status Executor::give_back() {
    if (!in_hand_) {
        return fail(Errc::kConflict, "not_in_hand", "Nobody has taken the vehicle by hand.");
    }
    if (!motion_.standing() || !way_.empty()) {
        return fail(Errc::kConflict, "still_moving", "The vehicle still moves. Let go first.");
    }
    hand_.give_back();
    way_.skip();
    in_hand_ = false;
    changed_ = true;
    return {};
}

}  // namespace pulseline::onboard
