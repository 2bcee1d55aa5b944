#include "core/fleet/legs/step_actions.hpp"

#include <algorithm>

#include "core/fleet/floor/carrying.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

const std::vector<StepAction>& actions_of_phase(const Step& step) {
    return step.phase == StepPhase::kAfter ? step.after : step.before;
}

std::string action_id(LegId leg, std::size_t index) {
    return leg.str() + "-" + std::to_string(index);
}

void enter(Step& step, StepPhase phase) {
    step.phase = phase;
    step.actions_done = 0;
}

/// One behind the last action of the leg that begins with `first`.
std::size_t end_of_leg(const std::vector<StepAction>& actions, std::size_t first) {
    if (first >= actions.size()) return actions.size();  // all are done, and only the end is not
    if (vda5050::is_transfer(actions[first].type)) return first + 1;
    const auto next =
        std::find_if(actions.begin() + static_cast<std::ptrdiff_t>(first), actions.end(),
                     [](const StepAction& action) { return vda5050::is_transfer(action.type); });
    return static_cast<std::size_t>(next - actions.begin());
}

bool has_action(const Leg& leg, const std::string& id) {
    return std::ranges::any_of(leg.nodes.front().actions,
                               [&](const vda5050::Action& action) { return action.id == id; });
}

void finish_step(FleetState& fleet, JobOrder& order, std::size_t step, Time now) {
    order.steps[step].state = StepState::kDone;
    order.current_step = step + 1;
    fleet.store(order);
    if (order.current_step == order.steps.size()) {
        set_order_state(fleet, order, JobState::kEnded, {}, {}, now);
    } else if (order.cancel_requested) {
        abort_order(fleet, order, order.reason, {}, now);
    }
}

}  // namespace

bool acts_next(const JobOrder& order, const LiveVehicle& live) {
    if (order.current_step >= order.steps.size()) return false;
    const Step& step = order.steps[order.current_step];
    // Moved away before its actions were done, it has to arrive again first.
    if (step.phase == StepPhase::kAfter && live.record.at_station != step.station) return false;
    return step.phase != StepPhase::kDrive && step.actions_done < actions_of_phase(step).size();
}

const StepAction* next_transfer(const JobOrder& order, const LiveVehicle& live) {
    if (!acts_next(order, live)) return nullptr;
    const Step& step = order.steps[order.current_step];
    const StepAction& next = actions_of_phase(step)[step.actions_done];
    return vda5050::is_transfer(next.type) ? &next : nullptr;
}

Result<std::optional<Reason>> prepare_transfer(FleetState& fleet, const JobOrder& order,
                                               LiveVehicle& live, Time now) {
    const StepAction* transfer = next_transfer(order, live);
    if (!transfer) return std::nullopt;
    if (Status may = may_transfer(fleet, live, *transfer); !may) return fail(may.error());
    if (transfer->type != vda5050::kPick) return std::nullopt;
    const auto* load = load_at(fleet, live.record.at_station);
    if (Status held = hold_floor_with(fleet, live, load, now); !held) return held.error().reason;
    return std::nullopt;
}

std::optional<Leg> next_actions_leg(const FleetState& fleet, JobOrder& order,
                                    const LiveVehicle& live, LegId id) {
    Step& step = order.steps[order.current_step];
    // Moved away before its actions were done: it has to arrive and measure again.
    if (step.phase == StepPhase::kAfter && live.record.at_station != step.station) {
        enter(step, StepPhase::kDrive);
    }
    if (step.phase == StepPhase::kBefore && step.actions_done >= step.before.size()) {
        enter(step, StepPhase::kDrive);
    }
    if (step.phase == StepPhase::kDrive) return std::nullopt;

    Leg leg;
    leg.id = id;
    leg.vehicle = live.record.id;
    leg.station = step.station;
    leg.mode = plant::MotionMode::kLinear;
    leg.hall = hall_of(fleet, live);
    leg.actions_only = true;
    // The drive still to come counts for the expected end.
    if (step.phase == StepPhase::kBefore) leg.duration_s = step.planned_s;
    vda5050::OrderNode node;
    node.node_id = step.phase == StepPhase::kAfter ? step.station.str() : "start";
    node.released = true;
    node.pose = live.record.pose;
    node.allowed_deviation_xy_m = 0.3;
    node.allowed_deviation_theta_rad = 0.1;
    node.map_id = leg.hall;
    const auto& wanted = actions_of_phase(step);
    const std::size_t end = end_of_leg(wanted, step.actions_done);
    for (std::size_t i = step.actions_done; i < end; ++i) {
        vda5050::Action action;
        action.type = wanted[i].type;
        action.params = wanted[i].params;
        if (vda5050::is_transfer(action.type)) action = transfer_action(fleet, live, wanted[i]);
        action.id = action_id(id, i);
        action.blocking = vda5050::BlockingType::kHard;
        node.actions.push_back(std::move(action));
    }
    leg.nodes.push_back(std::move(node));
    return leg;
}

namespace {

/// What the vehicle says of the leg's next action; nullptr: nothing, or there is none.
const vda5050::ActionState* told_of_next(const LiveVehicle& live, const Step& step) {
    if (step.actions_done >= actions_of_phase(step).size()) return nullptr;
    const std::string id = action_id(live.leg().id, step.actions_done);
    const auto& states = live.state.action_states;
    const auto found = std::ranges::find(states, id, &vda5050::ActionState::id);
    return found == states.end() ? nullptr : &*found;
}

/// Its next action is done; a load that it has moved is elsewhere from now on.
void count_done(FleetState& fleet, LiveVehicle& live, const JobOrder& order, Step& step, Time now) {
    const Leg& leg = live.leg();
    const StepAction& done = actions_of_phase(step)[step.actions_done];
    if (vda5050::is_transfer(done.type))
        note_transferred(fleet, live, done, {order.created_by, order.id, leg.id}, now);
    ++step.actions_done;
    add_event(fleet, now, event::kStepActionDone, order.id, leg.id, leg.vehicle, {},
              {{"action", done.type}, {"phase", to_string(step.phase)}});
}

}  // namespace

void count_done_before_cancel(FleetState& fleet, LiveVehicle& live, Time now) {
    if (!live.has_leg() || !live.delivery.cancelling() || !live.leg().actions_only) return;
    JobOrder* order = fleet.find(live.leg().order);
    if (!order || live.state.order_id != live.leg().id.str()) return;
    Step& step = order->steps[static_cast<std::size_t>(live.leg().step)];
    const std::size_t before = step.actions_done;
    while (const auto* told = told_of_next(live, step)) {
        if (told->status != vda5050::ActionStatus::kFinished) break;
        count_done(fleet, live, *order, step, now);
    }
    if (step.actions_done != before) fleet.store(*order);
}

void take_actions_leg(FleetState& fleet, LiveVehicle& live, Time now) {
    const Leg leg = live.leg();
    JobOrder* order = fleet.find(leg.order);
    if (!order) return;
    Step& step = order->steps[static_cast<std::size_t>(leg.step)];
    const auto& wanted = actions_of_phase(step);
    const std::size_t before = step.actions_done;
    while (const auto* found = told_of_next(live, step)) {
        const std::string& type = wanted[step.actions_done].type;
        if (found->status == vda5050::ActionStatus::kFailed) {
            end_leg(fleet, live, LegEnd::kDone, now);
            if (step.phase == StepPhase::kBefore) step.state = StepState::kPending;
            const Params params{{"action", type},
                                {"phase", to_string(step.phase)},
                                {"why", found->result_description}};
            add_event(fleet, now, event::kStepActionFailed, order->id, leg.id, leg.vehicle, {},
                      params);
            set_order_state(fleet, *order, JobState::kInterrupted, {"action_failed", params}, {},
                            now);
            return;
        }
        if (found->status != vda5050::ActionStatus::kFinished) break;
        count_done(fleet, live, *order, step, now);
    }
    if (step.actions_done != before) fleet.store(*order);
    if (has_action(leg, action_id(leg.id, step.actions_done)) || live.state.driving) return;
    end_leg(fleet, live, LegEnd::kDone, now);
    settle_load(fleet, live, now);  // the next leg begins with what it carries now
    step.leg = {};
    if (step.actions_done < wanted.size()) {
        fleet.store(*order);
    } else if (step.phase == StepPhase::kAfter) {
        finish_step(fleet, *order, static_cast<std::size_t>(leg.step), now);
    } else {
        enter(step, StepPhase::kDrive);
        fleet.store(*order);
    }
}

void handle_good_stop(FleetState& fleet, JobOrder& order, std::size_t step, Time now) {
    if (order.steps[step].after.empty() || order.cancel_requested) {
        finish_step(fleet, order, step, now);
        return;
    }
    enter(order.steps[step], StepPhase::kAfter);
    order.steps[step].state = StepState::kMeasuring;
    fleet.store(order);
}

}  // namespace pulseline::fleet
