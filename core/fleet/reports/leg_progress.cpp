#include "core/fleet/reports/leg_progress.hpp"

#include <algorithm>

#include "core/fleet/dispatch/charging.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/legs/expected_end.hpp"
#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/legs/stops.hpp"
#include "core/fleet/reports/action_states.hpp"
#include "core/fleet/reports/rejected_order.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

/// It shows its leg: what it has of it, and which nodes are behind it.
void handle_shown_leg(FleetState& fleet, LiveVehicle& live, Time now) {
    const vda5050::StateMessage& state = live.state;
    Leg& leg = live.leg();
    if (live.delivery.shown(now)) {
        add_event(fleet, now, event::kLegAccepted, leg.order, leg.id, leg.vehicle, {});
        if (JobOrder* order = fleet.find(leg.order)) expect_end(fleet, live, *order, now);
    }
    if (state.order_update_id >= leg.update_id) live.delivery.confirmed();
    if (state.last_node_id.empty()) return;
    const auto passed = static_cast<std::size_t>(std::clamp<std::int64_t>(
        state.last_node_sequence_id / 2 + 1, 1, static_cast<std::int64_t>(leg.nodes.size())));
    if (passed <= leg.passed_nodes) return;
    leg.passed_nodes = passed;
    pass_nodes(fleet, live, now);
    // After a restart it would hold floor again that others were granted since.
    fleet.store(live);
}

/// The step of a stop that has begun says so.
void show_measuring(FleetState& fleet, const Leg& leg) {
    JobOrder* order = fleet.find(leg.order);
    if (!order || leg.step >= static_cast<int>(order->steps.size())) return;
    Step& step = order->steps[static_cast<std::size_t>(leg.step)];
    if (step.state != StepState::kDriving) return;
    step.state = StepState::kMeasuring;
    fleet.store(*order);
}

enum class Stop { kNone, kOpen, kOver };  // the leg has no stop to measure, has it ahead, had it

/// The stop at the end of the leg, if it has one.
Stop handle_stop(FleetState& fleet, LiveVehicle& live, Time now) {
    const vda5050::StateMessage& state = live.state;
    const Leg& leg = live.leg();
    Stop stop = Stop::kNone;
    for (const auto& action : leg.nodes.back().actions) {
        if (action.type != vda5050::kMeasureStop) continue;
        stop = Stop::kOpen;
        const vda5050::ActionState* found = find_action(state, action.id);
        if (!found) continue;
        if (found->status == vda5050::ActionStatus::kFinished && found->measurement) {
            handle_measured_stop(fleet, live, *found->measurement, now);
            return Stop::kOver;
        }
        if (is_final(found->status)) {
            // A cancelOrder of before a restart fails the stop before the vehicle stands.
            if (!has_nothing_left(state)) return Stop::kOver;
            handle_failed_stop(fleet, live, found->result_description, now);
            return Stop::kOver;
        }
        if (found->status == vda5050::ActionStatus::kRunning) show_measuring(fleet, leg);
    }
    return stop;
}

/// A drive without an order, for others' sake or to a charger, whose vehicle has driven it.
void end_own_drive(FleetState& fleet, LiveVehicle& live, Time now) {
    const Leg& leg = live.leg();
    for (const auto& action : leg.nodes.back().actions) {
        const vda5050::ActionState* found = find_action(live.state, action.id);
        if (found && !is_final(found->status)) return;
        if (found && found->status == vda5050::ActionStatus::kFailed &&
            action.type == vda5050::kStartCharging) {
            charge_failed(fleet, live, found->result_description, now);
        }
    }
    add_event(fleet, now, event::kLegEnded, {}, leg.id, leg.vehicle, {});
    end_leg(fleet, live, LegEnd::kDone, now);
}

/// A vehicle without measureStop: its own pose at the last node is the measurement.
void handle_own_pose(FleetState& fleet, LiveVehicle& live, Time now) {
    vda5050::StopMeasurement found;
    found.pose = *live.state.pose;
    found.sigma_xy_m = live.state.deviation_range_m;
    found.method = "vehicle_pose";
    handle_measured_stop(fleet, live, found, now);
}

}  // namespace

void handle_leg_progress(FleetState& fleet, LiveVehicle& live, Time now) {
    const vda5050::StateMessage& state = live.state;
    Leg& leg = live.leg();
    if (state.order_id != leg.id.str()) return handle_other_order(fleet, live, now);
    handle_shown_leg(fleet, live, now);
    // What it still reports of a drive that it is to give up decides nothing.
    if (live.delivery.cancelling()) return;
    if (leg.actions_only) return take_actions_leg(fleet, live, now);
    const Stop stop = handle_stop(fleet, live, now);
    if (stop == Stop::kOver || !has_nothing_left(state)) return;
    // Who takes it by hand takes the rest away, too, that it waited for at the end of its base.
    const std::size_t owed = is_automatic(live) ? leg.released_nodes : leg.nodes.size();
    if (leg.passed_nodes < owed && state.order_update_id == leg.update_id) {
        return lose_order(fleet, live, now);
    }
    if (leg.order.empty() && leg.passed_nodes == leg.nodes.size()) {
        return end_own_drive(fleet, live, now);
    }
    if (stop == Stop::kNone && stands_at_stop(fleet, live) && state.pose) {
        handle_own_pose(fleet, live, now);
    }
}

}  // namespace pulseline::fleet
