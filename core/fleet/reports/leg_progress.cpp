#include "core/fleet/reports/leg_progress.hpp"

#include <algorithm>

#include "core/fleet/dispatch/charging.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/legs/expected_end.hpp"
#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/legs/stops.hpp"
#include "core/fleet/reports/action_states.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

const vda5050::VehicleError* rejection_of(const vda5050::StateMessage& state,
                                          const std::string& order_id) {
    for (const auto& error : state.errors) {
        for (const auto& [key, value] : error.references) {
            if (key == "orderId" && value == order_id) return &error;
        }
    }
    return nullptr;
}

/// Restarted, switched to manual or cancelled by hand: it does not carry out its order any more.
void lose_order(FleetState& fleet, VehicleRun& run, Time now) {
    require_person(fleet, run, {"vehicle_lost_order", {}}, now);
    forget_leg(fleet, run, now);
}

}  // namespace

void take_leg_progress(FleetState& fleet, VehicleRun& run, Time now) {
    const vda5050::StateMessage& state = run.state;
    Leg& leg = run.leg();
    if (state.order_id != leg.id.str()) {
        // Without pose it has restarted: an order sent before must not set it in motion.
        if (run.leg_seen || (!run.record.pose_known && !run.gave_up)) {
            lose_order(fleet, run, now);
        } else if (run.gave_up) {
            forget_leg(fleet, run, now);
        } else if (const auto* error = rejection_of(state, leg.id.str())) {
            require_person(
                fleet, run,
                {"order_rejected", {{"type", error->type}, {"text", error->description}}}, now);
            drop_leg(fleet, run, now);
        }
        return;
    }
    if (!run.leg_seen) {
        run.leg_seen = true;
        if (!run.leg_started) run.leg_started = now;
        add_event(fleet, now, "leg.accepted", leg.order, leg.id, leg.vehicle, {});
        if (JobOrder* order = fleet.find(leg.order)) expect_end(fleet, run, *order, now);
    }
    if (state.order_update_id >= leg.update_id) {
        run.update_sent.reset();
        run.update_sends = 0;
    }
    if (!state.last_node_id.empty()) {
        const auto passed = static_cast<std::size_t>(std::clamp<std::int64_t>(
            state.last_node_sequence_id / 2 + 1, 1, static_cast<std::int64_t>(leg.nodes.size())));
        if (passed > leg.passed_nodes) {
            leg.passed_nodes = passed;
            pass_nodes(fleet, run, now);
            // After a restart it would hold floor again that others were granted since.
            fleet.store(run);
        }
    }
    if (run.cancelling) return;
    if (leg.actions_only) return take_actions_leg(fleet, run, now);

    bool measures = false;
    for (const auto& action : leg.nodes.back().actions) {
        if (action.type != vda5050::kMeasureStop) continue;
        measures = true;
        const vda5050::ActionState* found = find_action(state, action.id);
        if (!found) continue;
        if (found->status == vda5050::ActionStatus::kFinished && found->measurement) {
            take_measured_stop(fleet, run, *found->measurement, now);
            return;
        }
        if (is_final(found->status)) {
            // A cancelOrder of before a restart fails the stop before the vehicle stands.
            if (!has_nothing_left(state)) return;
            take_failed_stop(fleet, run, found->result_description, now);
            return;
        }
        JobOrder* order = fleet.find(leg.order);
        if (found->status == vda5050::ActionStatus::kRunning && order &&
            leg.step < static_cast<int>(order->steps.size()) &&
            order->steps[static_cast<std::size_t>(leg.step)].state == StepState::kDriving) {
            order->steps[static_cast<std::size_t>(leg.step)].state = StepState::kMeasuring;
            fleet.store(*order);
        }
    }
    const bool makes_way = leg.order.empty();
    const bool idle = has_nothing_left(state);
    // Who takes it by hand takes the rest away, too, that it waited for at the end of its base.
    const std::size_t owed = is_automatic(run) ? leg.released_nodes : leg.nodes.size();
    if (idle && leg.passed_nodes < owed && state.order_update_id == leg.update_id) {
        return lose_order(fleet, run, now);
    }
    if (makes_way && idle && leg.passed_nodes == leg.nodes.size()) {
        for (const auto& action : leg.nodes.back().actions) {
            const vda5050::ActionState* found = find_action(state, action.id);
            if (found && !is_final(found->status)) return;
            if (found && found->status == vda5050::ActionStatus::kFailed &&
                action.type == vda5050::kStartCharging) {
                charge_failed(fleet, run, found->result_description, now);
            }
        }
        add_event(fleet, now, "leg.ended", {}, leg.id, leg.vehicle, {});
        drop_leg(fleet, run, now, true);
        return;
    }
    if (!measures && idle && stands_at_stop(fleet, run) && state.pose) {
        // A vehicle without measureStop: its own pose at the last node is the measurement.
        vda5050::StopMeasurement found;
        found.pose = *state.pose;
        found.sigma_xy_m = state.deviation_range_m;
        found.method = "vehicle_pose";
        take_measured_stop(fleet, run, found, now);
    }
}

}  // namespace pulseline::fleet
