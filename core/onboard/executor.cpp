#include "core/onboard/executor.hpp"

#include <algorithm>
#include <utility>

#include "core/vda5050/actions.hpp"

namespace pulseline::onboard {
namespace {

using vda5050::Action;
using vda5050::ActionState;
using vda5050::ActionStatus;
using vda5050::VehicleError;

// The base is asked for this long before braking for its end would begin.
constexpr double kAskForBase_s = 1.0;

}  // namespace

Executor::Executor(Drive& motion, StopSensing& sensing, std::string map_id, Equipment* equipment,
                   control::MotionCompensation compensation)
    : motion_(motion),
      procedure_(motion, sensing, {}, std::move(compensation)),
      equipment_(equipment),
      map_id_(std::move(map_id)),
      way_(motion),
      hand_(motion) {}

OrderContext Executor::context() const {
    OrderContext context;
    context.order_id = order_id_;
    context.order_update_id = order_update_id_;
    context.idle = order_done() && !procedure_.running();
    context.cancelled = cancelled_;
    context.cancelling = !cancel_id_.empty();
    context.stitch_node_id = base_end_.node_id;
    context.stitch_sequence_id = base_end_.sequence_id;
    context.in_hand = in_hand_;
    if (position_initialized_) context.pose = motion_.believed_pose();
    context.map_id = map_id_;
    if (equipment_ != nullptr) context.node_actions = equipment_->action_types();
    return context;
}

void Executor::report(VehicleError error) {
    std::erase_if(errors_, [&](const VehicleError& old) {
        return old.type == error.type && old.references == error.references;
    });
    errors_.push_back(std::move(error));
    changed_ = true;
}

void Executor::handle(const vda5050::OrderMessage& order) {
    const OrderDecision decision = decide_order(order, context());
    switch (decision.kind) {
        case OrderDecision::Kind::kDuplicate:
            changed_ = true;  // the sender has not seen our answer yet
            return;
        case OrderDecision::Kind::kRejected:
            report(decision.error);
            return;
        case OrderDecision::Kind::kNewOrder:
            start_order(order);
            return;
        case OrderDecision::Kind::kUpdate:
            extend_order(order);
            return;
    }
}

void Executor::start_order(const vda5050::OrderMessage& order) {
    order_id_ = order.order_id;
    order_update_id_ = order.order_update_id;
    cancelled_ = false;
    errors_.clear();
    order_actions_.clear();
    const auto& first = order.nodes.front();
    base_end_ = {first.node_id, first.sequence_id, true};
    for (const auto& action : first.actions) add_action(action, ActionStatus::kWaiting);
    append(order);
    traverse(first);
}

void Executor::extend_order(const vda5050::OrderMessage& order) {
    order_update_id_ = order.order_update_id;
    errors_.clear();
    for (const auto& hop : way_.drop_horizon()) {
        for (const auto* actions : {&hop.node.actions, &hop.on_edge}) {
            for (const auto& action : *actions) {
                std::erase_if(order_actions_, [&](const auto& s) { return s.id == action.id; });
            }
        }
    }
    append(order);
    changed_ = true;
}

/// Everything of the message behind its first node, which the vehicle has or stands on.
void Executor::append(const vda5050::OrderMessage& order) {
    for (std::size_t i = 1; i < order.nodes.size(); ++i) {
        const auto& node = order.nodes[i];
        way_.append(order.edges[i - 1], node);
        for (const auto& action : order.edges[i - 1].actions) {
            add_action(action, ActionStatus::kWaiting);
        }
        for (const auto& action : node.actions) add_action(action, ActionStatus::kWaiting);
        if (node.released) base_end_ = {node.node_id, node.sequence_id, true};
    }
}

void Executor::traverse(const vda5050::OrderNode& node) {
    last_node_id_ = node.node_id;
    last_node_sequence_id_ = node.sequence_id;
    waiting_.insert(waiting_.end(), node.actions.begin(), node.actions.end());
    changed_ = true;
}

void Executor::step(double dt_s) {
    if (in_hand_) return step_in_hand(dt_s);
    if (paused_ || lost_ || !cancel_id_.empty()) {
        motion_.hold();
    } else {
        motion_.release();
    }
    motion_.step(dt_s);
    take_traversals();
    run_lift();
    run_actions(dt_s);
    finish_cancel();
    finish_pause();
    queue_edges();
    note_motion();
}

void Executor::note_codes(const std::vector<std::string>& payloads) {
    for (const auto& payload : payloads) {
        codes_read_.push_back(payload);
        // Read behind the node, of a picture taken before it or of a code that reaches beyond it.
        const auto is_it = [&](const auto& marker) { return marker.payload == payload; };
        ActionState* passed = find_action(edge_passed_.id);
        if (passed && passed->result_description.empty() &&
            std::ranges::any_of(edge_passed_.markers, is_it)) {
            passed->result_description = payload;
            changed_ = true;
        }
    }
}

/// A code that lies where edges meet is on all of them, and read once.
std::string Executor::take_codes_read_on(const vda5050::Action& action) {
    std::vector<std::string> read;
    for (const auto& marker : action.markers) {
        const auto is_it = [&](const auto& payload) { return payload == marker.payload; };
        if (std::ranges::any_of(codes_read_before_, is_it)) read.push_back(marker.payload);
    }
    for (auto& payload : std::exchange(codes_read_, {})) {
        if (std::ranges::find(read, payload) == read.end()) read.push_back(std::move(payload));
    }
    codes_read_before_ = read;
    std::string text;
    for (const auto& payload : read) text += (text.empty() ? "" : ", ") + payload;
    return text;
}

/// The edge is left, and what was to be done on it ends.
void Executor::finish_on_edge(const Action& action) {
    if (action.type != vda5050::kObserveMarkers) {
        return set_action(action.id, ActionStatus::kFinished);
    }
    set_action(action.id, ActionStatus::kFinished, take_codes_read_on(action));
    edge_passed_ = action;
}

void Executor::take_traversals() {
    for (const auto& hop : way_.take_passed()) {
        for (const auto& action : hop.on_edge) finish_on_edge(action);
        traverse(hop.node);
    }
    if (way_.empty() || motion_.standing()) return;
    for (const auto& action : way_.edges().front().actions) {
        const ActionState* state = find_action(action.id);
        if (state && state->status == ActionStatus::kWaiting) {
            set_action(action.id, ActionStatus::kRunning);
        }
    }
}

void Executor::queue_edges() {
    if (!waiting_.empty() || procedure_.running() || !cancel_id_.empty()) return;
    if (held_ && motion_.idle()) return;
    if (equipment_ != nullptr && (equipment_->holds_vehicle() || equipment_->half_transferred()))
        return;
    way_.hand_over();
}

bool Executor::waits_to_begin() const {
    return held_ && motion_.idle() && !way_.empty() && waiting_.empty() && !paused_;
}

bool Executor::may_go_round() const {
    const bool at_work = procedure_.running() || !waiting_.empty() || !cancel_id_.empty();
    return motion_.standing() && !motion_.stop_cause() && !way_.empty() && !at_work && !paused_ &&
           !in_hand_;
}

void Executor::go_round(const planning::Detour& detour) {
    way_.go_round(detour);
    changed_ = true;
}

/// Node actions one after the other, standing: all that we announce are HARD or treated so.
void Executor::run_actions(double dt_s) {
    if (procedure_.running()) {
        const bool searched = procedure_.searching();
        if (const auto outcome = procedure_.step(dt_s)) finish_stop(*outcome);
        changed_ |= searched != procedure_.searching();
        return;
    }
    if (waiting_.empty() || paused_ || !cancel_id_.empty() || !motion_.idle()) return;
    if (!running_lift_.empty()) return;  // an order that came meanwhile waits for its end
    const Action& action = waiting_.front();
    if (!action.stop_target) return run_equipment();
    running_stop_ = action.id;
    set_action(action.id, ActionStatus::kRunning);
    procedure_.start(*action.stop_target, action.type == vda5050::kAdjustToMarker);
}

void Executor::run_equipment() {
    const Action& action = waiting_.front();
    if (running_equipment_ != action.id || equipment_held_) {
        running_equipment_ = action.id;
        equipment_held_ = false;
        set_action(action.id, ActionStatus::kRunning);
        if (auto why_not = equipment_->begin(action)) {
            set_action(action.id, ActionStatus::kFailed, std::move(*why_not));
            waiting_.pop_front();
            return;
        }
    }
    note_equipment_end();
}

/// What an order wanted of it is done, or has failed.
void Executor::note_equipment_end() {
    if (waiting_.empty() || waiting_.front().id != running_equipment_) return;
    if (equipment_held_ || equipment_->busy()) return;
    const auto failure = equipment_->failure();
    set_action(running_equipment_, failure ? ActionStatus::kFailed : ActionStatus::kFinished,
               failure.value_or(""));
    waiting_.pop_front();
}

/// What moves brackets or feet outside an order has come to its end.
void Executor::run_lift() {
    if (running_lift_.empty() || equipment_->busy()) return;
    const auto failure = equipment_->failure();
    set_action(std::exchange(running_lift_, {}),
               failure ? ActionStatus::kFailed : ActionStatus::kFinished, failure.value_or(""));
}

/// A pause holds what moves, too. What an order wants goes on with it; what a person began to move
/// outside one, a person begins again.
void Executor::hold_equipment() {
    if (equipment_ == nullptr || !equipment_->busy()) return;
    if (!running_lift_.empty()) return stop_equipment("vehicle_paused");
    equipment_->abort();
    equipment_held_ = true;
    set_action(running_equipment_, ActionStatus::kPaused);
}

/// What moves stays where it is, and what moved it has failed.
void Executor::stop_equipment(const char* why) {
    if (equipment_ == nullptr || !equipment_->busy()) return;
    equipment_->abort();
    if (!running_lift_.empty()) {
        return set_action(std::exchange(running_lift_, {}), ActionStatus::kFailed, why);
    }
    set_action(running_equipment_, ActionStatus::kFailed, why);
    if (!waiting_.empty() && waiting_.front().id == running_equipment_) waiting_.pop_front();
}

void Executor::lose_link() { stop_equipment("link_lost"); }

void Executor::finish_stop(const StopProcedure::Outcome& outcome) {
    if (ActionState* state = find_action(running_stop_)) {
        state->measurement = outcome.measurement;
        if (!outcome.succeeded) state->measurement.reset();
    }
    set_action(running_stop_, outcome.succeeded ? ActionStatus::kFinished : ActionStatus::kFailed,
               outcome.why_not);
    if (outcome.measurement) know_pose();
    if (!waiting_.empty() && waiting_.front().id == running_stop_) waiting_.pop_front();
    running_stop_.clear();
}

void Executor::know_pose() {
    position_initialized_ = true;
    lost_.reset();
}

void Executor::lose_pose(vda5050::VehicleError why) {
    position_initialized_ = false;
    lost_ = std::move(why);
    changed_ = true;
}

void Executor::finish_cancel() {
    if (cancel_id_.empty() || !motion_.standing() || procedure_.running()) return;
    motion_.release();
    motion_.acknowledge();
    drop_order();
    set_action(cancel_id_, ActionStatus::kFinished);
    cancel_id_.clear();
}

void Executor::drop_order() {
    way_.clear();
    waiting_.clear();  // of nodes passed while braking
}

void Executor::finish_pause() {
    if (pause_id_.empty() || !motion_.standing()) return;
    set_action(pause_id_, ActionStatus::kFinished);
    pause_id_.clear();
}

void Executor::note_motion() {
    const bool driving = !motion_.standing();
    const double ask_m = motion_.braking_m() + std::abs(motion_.velocity_mps()) * kAskForBase_s;
    const bool ends = way_.base_handed_over() && motion_.remaining_m() <= ask_m;
    const bool ask = way_.has_horizon() && (ends || base_wanted_);
    const bool stopped = motion_.stop_cause().has_value();
    changed_ |= driving != driving_ || ask != new_base_request_ || stopped != stopped_;
    driving_ = driving;
    stopped_ = stopped;
    new_base_request_ = ask;
}

bool Executor::take_changed() { return std::exchange(changed_, false); }

bool Executor::take_factsheet_request() { return std::exchange(factsheet_requested_, false); }

void Executor::write_state(vda5050::StateMessage& state) const {
    state.order_id = order_id_;
    state.order_update_id = order_update_id_;
    state.last_node_id = last_node_id_;
    state.last_node_sequence_id = last_node_sequence_id_;
    state.node_states.clear();
    state.edge_states.clear();
    for (const auto& node : way_.nodes()) {
        state.node_states.push_back({node.node_id, node.sequence_id, node.released});
    }
    for (const auto& edge : way_.edges()) {
        state.edge_states.push_back({edge.edge_id, edge.sequence_id, edge.released});
    }
    state.operating_mode = in_hand_ ? "MANUAL" : "AUTOMATIC";
    state.driving = driving_;
    state.paused = paused_;
    state.new_base_request = new_base_request_;
    state.distance_since_last_node_m = way_.distance_since_last_node_m();
    state.position_initialized = position_initialized_;
    state.map_id = map_id_;
    state.pose.reset();
    if (position_initialized_) state.pose = motion_.believed_pose();
    state.velocity_mps = motion_.velocity_mps();
    state.turn_rate_radps = motion_.turn_rate_radps();
    state.action_states = order_actions_;
    state.action_states.insert(state.action_states.end(), instant_actions_.begin(),
                               instant_actions_.end());
    state.errors = errors_;
    if (lost_) state.errors.push_back(*lost_);
    if (equipment_ != nullptr && !equipment_->busy() && equipment_->half_transferred()) {
        state.errors.push_back({vda5050::kLoadHalfTaken, false, vda5050::kLoadHalfTakenWords, {}});
    }
    if (procedure_.searching()) {
        state.errors.push_back({"codesNotInView",
                                false,
                                "No code of the station is in view where it should be. The vehicle "
                                "looks for them round there.",
                                {}});
    }
}

}  // namespace pulseline::onboard
