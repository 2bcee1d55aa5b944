// The instant actions of Executor.
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/onboard/executor.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::onboard {
namespace {

using vda5050::Action;
using vda5050::ActionState;
using vda5050::ActionStatus;

// Final instant actions shown at most; the server has long seen older ones.
constexpr std::size_t kInstantActionsKept = 20;
constexpr const char* kStopped = "lifts_stopped";

bool is_final(ActionStatus status) {
    return status == ActionStatus::kFinished || status == ActionStatus::kFailed;
}

}  // namespace

ActionState* Executor::find_action(const std::string& id) {
    for (auto* list : {&order_actions_, &instant_actions_}) {
        for (auto& state : *list) {
            if (state.id == id) return &state;
        }
    }
    return nullptr;
}

void Executor::add_action(const Action& action, ActionStatus status, std::string result) {
    // Only actions of an order wait; instant ones begin or fail at once.
    auto& list = status == ActionStatus::kWaiting ? order_actions_ : instant_actions_;
    list.push_back({action.id, action.type, status, std::move(result), std::nullopt});
    changed_ = true;
}

void Executor::set_action(const std::string& id, ActionStatus status, std::string result) {
    ActionState* state = find_action(id);
    if (state == nullptr) return;
    state->status = status;
    state->result_description = std::move(result);
    changed_ = true;
}

void Executor::forget_old_instant_actions() {
    while (instant_actions_.size() > kInstantActionsKept) {
        const auto oldest = std::find_if(instant_actions_.begin(), instant_actions_.end(),
                                         [](const auto& s) { return is_final(s.status); });
        if (oldest == instant_actions_.end()) return;
        instant_actions_.erase(oldest);
    }
}

void Executor::handle(const vda5050::InstantActionsMessage& message) {
    for (const auto& action : message.actions) {
        changed_ = true;
        // A resent action is answered by the state, not done twice.
        if (find_action(action.id) != nullptr) continue;
        handle_instant(action);
    }
    forget_old_instant_actions();
}

void Executor::handle_instant(const Action& action) {
    if (action.type == vda5050::kCancelOrder) return cancel_order(action);
    if (action.type == vda5050::kInitPosition) return init_position(action);
    if (action.type == vda5050::kSetTransmitters) return set_transmitters(action);
    if (action.type == vda5050::kSetReflectors) return set_reflectors(action);
    if (action.type == vda5050::kMeasureStop || action.type == vda5050::kAdjustToMarker) {
        return instant_stop(action);
    }
    if (equipment_ != nullptr && action.type == vda5050::kStopCharging)
        return instant_equipment(action);
    if (can_lift(action.type)) return instant_lift(action);
    if (action.type == vda5050::kStopLifts && has_lifts()) {
        stop_equipment(kStopped);
        return add_action(action, ActionStatus::kFinished);
    }
    if (action.type == vda5050::kStartPause) {
        paused_ = true;
        hold_equipment();
        must_let_go_ = in_hand_;
        brake_by_hand();
        // An earlier startPause still braking is answered by the same standstill.
        if (!pause_id_.empty()) set_action(pause_id_, ActionStatus::kFinished);
        pause_id_ = action.id;
        return add_action(action, ActionStatus::kRunning);
    }
    if (action.type == vda5050::kStopPause) {
        paused_ = false;
        motion_.acknowledge();
        if (!pause_id_.empty()) {
            set_action(std::exchange(pause_id_, {}), ActionStatus::kFailed,
                       "overtaken by stopPause");
        }
        return add_action(action, ActionStatus::kFinished);
    }
    if (action.type == vda5050::kFactsheetRequest) {
        factsheet_requested_ = true;
        return add_action(action, ActionStatus::kFinished);
    }
    if (action.type == vda5050::kStateRequest) return add_action(action, ActionStatus::kFinished);
    add_action(action, ActionStatus::kFailed, "unknown_action: this vehicle has no " + action.type);
    vda5050::VehicleError error;
    error.type = "instantActionError";
    error.description = "instant action " + action.type + " is not supported";
    error.references = {{"actionId", action.id}};
    report(std::move(error));
}

void Executor::cancel_order(const Action& action) {
    if (!cancel_id_.empty()) {
        return add_action(action, ActionStatus::kFailed, "another cancelOrder is at work");
    }
    if (order_done()) {
        add_action(action, ActionStatus::kFailed, "noOrderToCancel");
        vda5050::VehicleError error;
        error.type = "noOrderToCancel";
        error.description = "there is no active order to cancel";
        error.references = {{"actionId", action.id}};
        return report(std::move(error));
    }
    cancel_id_ = action.id;
    cancelled_ = true;
    abort_actions("cancelled");
    add_action(action, ActionStatus::kRunning);
}

void Executor::abort_actions(const char* why) {
    if (equipment_ != nullptr) note_equipment_end();  // it may have ended since the last step
    stop_equipment(why);
    for (auto& state : order_actions_) {
        const bool on_edge = is_edge_action(state.type) && !is_final(state.status);
        const bool to_do =
            state.status == ActionStatus::kWaiting || state.status == ActionStatus::kPaused;
        if (!to_do && !on_edge) continue;
        state.status = ActionStatus::kFailed;
        state.result_description = why;
    }
    waiting_.clear();
    equipment_held_ = false;
    procedure_.abort();
}

void Executor::init_position(const Action& action) {
    if (!action.init_position) {
        return add_action(action, ActionStatus::kFailed, "x, y, theta and mapId are missing");
    }
    if (!motion_.idle() || procedure_.running() || !order_done()) {
        return add_action(action, ActionStatus::kFailed, "an order is active; cancel it first");
    }
    if (action.init_position->map_id != map_id_) {
        return add_action(
            action, ActionStatus::kFailed,
            "map " + action.init_position->map_id + " is not on this vehicle; it has " + map_id_);
    }
    motion_.set_believed(action.init_position->pose);
    motion_.acknowledge();
    know_pose();
    told_ = action.init_position;
    add_action(action, ActionStatus::kFinished);
}

void Executor::set_transmitters(const Action& action) {
    if (motion_.type().receivers.empty()) {
        return add_action(action, ActionStatus::kFailed, "this vehicle has no receivers of iGPS");
    }
    transmitters_.clear();
    std::ranges::copy_if(
        action.transmitters, std::back_inserter(transmitters_),
        [&](const plant::Transmitter& transmitter) { return transmitter.hall.str() == map_id_; });
    add_action(action, ActionStatus::kFinished);
}

void Executor::set_reflectors(const Action& action) {
    if (!motion_.type().navigation_scanner) {
        return add_action(action, ActionStatus::kFailed, "this vehicle has no navigation scanner");
    }
    reflectors_.clear();
    std::ranges::copy_if(
        action.reflectors, std::back_inserter(reflectors_),
        [&](const plant::Reflector& reflector) { return reflector.hall.str() == map_id_; });
    add_action(action, ActionStatus::kFinished);
}

void Executor::instant_stop(const Action& action) {
    if (!action.stop_target) {
        return add_action(action, ActionStatus::kFailed, "target is missing");
    }
    const bool corrects = action.type == vda5050::kAdjustToMarker;
    const bool barred = paused_ || (in_hand_ && corrects);
    if (!motion_.idle() || procedure_.running() || barred || (corrects && !order_done())) {
        return add_action(action, ActionStatus::kFailed, "the vehicle is at work");
    }
    add_action(action, ActionStatus::kRunning);
    running_stop_ = action.id;
    procedure_.start(*action.stop_target, corrects);
}

bool Executor::has_lifts() const {
    return equipment_ != nullptr &&
           std::ranges::any_of(equipment_->action_types(), vda5050::is_lift);
}

bool Executor::can_lift(const std::string& action_type) const {
    return has_lifts() && vda5050::is_lift(action_type) &&
           std::ranges::find(equipment_->action_types(), action_type) !=
               equipment_->action_types().end();
}

/// Brackets and feet outside an order: one movement at a time, the vehicle standing and nothing
/// else at work.
void Executor::instant_lift(const Action& action) {
    const char* why_not = nullptr;
    if (equipment_->busy()) {
        why_not = "lifts_moving";
    } else if (paused_) {
        why_not = "vehicle_paused";
    } else if (!motion_.idle() || procedure_.running() || !order_done()) {
        why_not = "vehicle_busy";
    }
    if (why_not != nullptr) return add_action(action, ActionStatus::kFailed, why_not);
    if (auto refused = equipment_->begin(action)) {
        return add_action(action, ActionStatus::kFailed, std::move(*refused));
    }
    running_lift_ = action.id;
    add_action(action, ActionStatus::kRunning);
}

void Executor::instant_equipment(const Action& action) {
    auto why_not = equipment_->begin(action);
    add_action(action, why_not ? ActionStatus::kFailed : ActionStatus::kFinished,
               why_not.value_or(""));
}

}  // namespace pulseline::onboard
