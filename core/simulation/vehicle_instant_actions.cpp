// The instant actions of VehicleExecutor.
#include <algorithm>
#include <utility>

#include "core/simulation/vehicle_executor.hpp"

namespace pulseline::simulation {
namespace {

using fleet::Action;
using fleet::ActionState;
using fleet::ActionStatus;

// Final instant actions shown at most; the server has long seen older ones.
constexpr std::size_t kInstantActionsKept = 20;

bool is_final(ActionStatus status) {
    return status == ActionStatus::kFinished || status == ActionStatus::kFailed;
}

}  // namespace

ActionState* VehicleExecutor::find_action(const std::string& id) {
    for (auto* list : {&order_actions_, &instant_actions_}) {
        for (auto& state : *list) {
            if (state.id == id) return &state;
        }
    }
    return nullptr;
}

void VehicleExecutor::add_action(const Action& action, ActionStatus status, std::string result) {
    // Only actions of an order wait; instant ones begin or fail at once.
    auto& list = status == ActionStatus::kWaiting ? order_actions_ : instant_actions_;
    list.push_back({action.id, action.type, status, std::move(result), std::nullopt});
    changed_ = true;
}

void VehicleExecutor::set_action(const std::string& id, ActionStatus status, std::string result) {
    ActionState* state = find_action(id);
    if (state == nullptr) return;
    state->status = status;
    state->result_description = std::move(result);
    changed_ = true;
}

void VehicleExecutor::forget_old_instant_actions() {
    while (instant_actions_.size() > kInstantActionsKept) {
        const auto oldest = std::find_if(instant_actions_.begin(), instant_actions_.end(),
                                         [](const auto& s) { return is_final(s.status); });
        if (oldest == instant_actions_.end()) return;
        instant_actions_.erase(oldest);
    }
}

void VehicleExecutor::handle(const fleet::InstantActionsMessage& message) {
    for (const auto& action : message.actions) {
        changed_ = true;
        // A resent action is answered by the state, not done twice.
        if (find_action(action.id) != nullptr) continue;
        handle_instant(action);
    }
    forget_old_instant_actions();
}

void VehicleExecutor::handle_instant(const Action& action) {
    if (action.type == "cancelOrder") return cancel_order(action);
    if (action.type == "initPosition") return init_position(action);
    if (action.type == "measureStop" || action.type == "adjustToMarker") {
        return instant_stop(action);
    }
    if (equipment_ != nullptr && action.type == "stopCharging") return instant_equipment(action);
    if (action.type == "startPause") {
        paused_ = true;
        // An earlier startPause still braking is answered by the same standstill.
        if (!pause_id_.empty()) set_action(pause_id_, ActionStatus::kFinished);
        pause_id_ = action.id;
        return add_action(action, ActionStatus::kRunning);
    }
    if (action.type == "stopPause") {
        paused_ = false;
        motion_.acknowledge();
        if (!pause_id_.empty()) {
            set_action(std::exchange(pause_id_, {}), ActionStatus::kFailed,
                       "overtaken by stopPause");
        }
        return add_action(action, ActionStatus::kFinished);
    }
    if (action.type == "factsheetRequest") {
        factsheet_requested_ = true;
        return add_action(action, ActionStatus::kFinished);
    }
    if (action.type == "stateRequest") return add_action(action, ActionStatus::kFinished);
    add_action(action, ActionStatus::kFailed, "unknown_action: this vehicle has no " + action.type);
    fleet::VehicleError error;
    error.type = "instantActionError";
    error.description = "instant action " + action.type + " is not supported";
    error.references = {{"actionId", action.id}};
    report(std::move(error));
}

void VehicleExecutor::cancel_order(const Action& action) {
    if (!cancel_id_.empty()) {
        return add_action(action, ActionStatus::kFailed, "another cancelOrder is at work");
    }
    if (order_done()) {
        add_action(action, ActionStatus::kFailed, "noOrderToCancel");
        fleet::VehicleError error;
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

void VehicleExecutor::abort_actions(const char* why) {
    for (auto& state : order_actions_) {
        if (state.status != ActionStatus::kWaiting) continue;
        state.status = ActionStatus::kFailed;
        state.result_description = why;
    }
    waiting_.clear();
    procedure_.abort();
    if (equipment_ != nullptr && equipment_->busy()) {
        equipment_->abort();
        set_action(running_equipment_, ActionStatus::kFailed, why);
    }
}

void VehicleExecutor::init_position(const Action& action) {
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
    position_initialized_ = true;
    add_action(action, ActionStatus::kFinished);
}

void VehicleExecutor::instant_stop(const Action& action) {
    if (!action.stop_target) {
        return add_action(action, ActionStatus::kFailed, "target is missing");
    }
    const bool corrects = action.type == "adjustToMarker";
    const bool barred = paused_ || (in_hand_ && corrects);
    if (!motion_.idle() || procedure_.running() || barred || (corrects && !order_done())) {
        return add_action(action, ActionStatus::kFailed, "the vehicle is at work");
    }
    add_action(action, ActionStatus::kRunning);
    running_stop_ = action.id;
    procedure_.start(*action.stop_target, corrects);
}

void VehicleExecutor::instant_equipment(const Action& action) {
    auto why_not = equipment_->begin(action, motion_.true_pose());
    add_action(action, why_not ? ActionStatus::kFailed : ActionStatus::kFinished,
               why_not.value_or(""));
}

}  // namespace pulseline::simulation
