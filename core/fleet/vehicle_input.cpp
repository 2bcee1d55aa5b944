#include <algorithm>
#include <utility>

#include "core/fleet/state.hpp"
#include "core/fleet/step_actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr int kErrorsPerMinute = 10;  // of one vehicle that become events

constexpr Duration kLongestWay = std::chrono::seconds(10);   // of a message to a vehicle
constexpr Duration kForeignAfter = std::chrono::seconds(5);  // an own leg just ended is told sooner

bool is_final(ActionStatus status) {
    return status == ActionStatus::kFinished || status == ActionStatus::kFailed;
}

const ActionState* find_action(const StateMessage& state, const std::string& id) {
    for (const auto& action : state.action_states) {
        if (action.id == id) return &action;
    }
    return nullptr;
}

void finish_cancel(FleetState& fleet, VehicleRun& run, Time now) {
    JobOrder* order = fleet.orders.of(run.record.id);
    drop_leg(fleet, run, now);
    if (!order) return;
    if (order->current_step < order->steps.size()) {
        order->steps[order->current_step].state = StepState::kPending;
        order->steps[order->current_step].leg = {};
    }
    if (order->cancel_requested) {
        abort_order(fleet, *order, order->reason, {}, now);
    } else {
        fleet.store(*order);
    }
}

void take_action_states(FleetState& fleet, VehicleRun& run, Time now) {
    bool cancelled = false;
    bool again = false;
    std::erase_if(run.actions, [&](const PendingAction& pending) {
        const ActionState* found = find_action(run.state, pending.action.id);
        if (!found || !is_final(found->status)) return false;
        // A cancel is done when the vehicle says so AND stands; floor is freed only then.
        if (pending.action.type == "cancelOrder") {
            if (run.state.driving || (run.has_leg() && !run.record.pose_known)) return false;
            // It knew of no order to cancel: that may still be on its way, or have come since.
            const bool failed = found->status == ActionStatus::kFailed;
            if (failed && run.has_leg() && is_on_its_way(run)) return false;
            again = failed && run.has_leg() && run.state.order_id == run.leg().id.str() &&
                    !has_nothing_left(run.state);
            cancelled = !again;
        }
        add_event(fleet, now, "vehicle.action", {}, {}, run.record.id, {},
                  {{"action", pending.action.type},
                   {"action_id", pending.action.id},
                   {"status", found->status == ActionStatus::kFinished ? "finished" : "failed"},
                   {"result", found->result_description}});
        return true;
    });
    if (cancelled) finish_cancel(fleet, run, now);
    if (!again) return;
    run.cancelling = false;
    cancel_leg(fleet, run, now);
}

const VehicleError* rejection_of(const StateMessage& state, const std::string& order_id) {
    for (const auto& error : state.errors) {
        for (const auto& [key, value] : error.references) {
            if (key == "orderId" && value == order_id) return &error;
        }
    }
    return nullptr;
}

/// A state that was overtaken on its way tells of a floor the vehicle has left since. Header ids
/// are 32 bit and begin anew.
bool is_overtaken(const VehicleRun& run, const StateMessage& state) {
    constexpr std::int64_t kHalf = std::int64_t{1} << 31;
    if (state.header_id == 0 || run.newest_header == 0) return false;
    const std::int64_t ahead = state.header_id - run.newest_header;
    return (ahead <= 0 && ahead > -kHalf) || ahead > kHalf;
}

/// Restarted, switched to manual or cancelled by hand: it does not carry out its order any more.
void lose_order(FleetState& fleet, VehicleRun& run, Time now) {
    require_person(fleet, run, {"vehicle_lost_order", {}}, now);
    forget_leg(fleet, run, now);
}

void take_leg_progress(FleetState& fleet, VehicleRun& run, Time now) {
    const StateMessage& state = run.state;
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
        if (action.type != "measureStop") continue;
        measures = true;
        const ActionState* found = find_action(state, action.id);
        if (!found) continue;
        if (found->status == ActionStatus::kFinished && found->measurement) {
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
        if (found->status == ActionStatus::kRunning && order &&
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
            const ActionState* found = find_action(state, action.id);
            if (found && !is_final(found->status)) return;
            if (found && found->status == ActionStatus::kFailed && action.type == "startCharging") {
                charge_failed(fleet, run, found->result_description, now);
            }
        }
        add_event(fleet, now, "leg.ended", {}, leg.id, leg.vehicle, {});
        drop_leg(fleet, run, now, true);
        return;
    }
    if (!measures && idle && stands_at_stop(fleet, run) && state.pose) {
        // A vehicle without measureStop: its own pose at the last node is the measurement.
        StopMeasurement found;
        found.pose = *state.pose;
        found.sigma_xy_m = state.deviation_range_m;
        found.method = "vehicle_pose";
        take_measured_stop(fleet, run, found, now);
    }
}

/// Of another master, or given by this server before its database was put back to an older copy:
/// no leg of its own can begin before that is gone, and only a person knows whether it may go.
void watch_foreign_order(FleetState& fleet, VehicleRun& run, Time now) {
    if (!has_foreign_order(run)) {
        run.foreign_since.reset();
        return;
    }
    if (!run.foreign_since) run.foreign_since = now;
    if (now - *run.foreign_since < kForeignAfter || is_asked(run, "cancelOrder")) return;
    if (run.record.integration != Integration::kUtilise) return;
    require_person(
        fleet, run,
        {"foreign_order", {{"vehicle", run.record.id.str()}, {"order", run.state.order_id}}}, now);
}

/// An error is its type and what it refers to; its text may count up or tell the time.
void note_errors(FleetState& fleet, VehicleRun& run, const std::vector<VehicleError>& before,
                 Time now) {
    for (const auto& error : run.state.errors) {
        const bool known = std::any_of(before.begin(), before.end(), [&](const auto& old) {
            return old.type == error.type && old.references == error.references;
        });
        if (known || !may_tell_error(fleet, run, now)) continue;
        add_event(fleet, now, "vehicle.error", {}, run.record.leg, run.record.id, {},
                  {{"type", error.type}, {"fatal", error.fatal}, {"text", error.description}});
    }
}

/// Somebody has taken the vehicle into their hands, or given it back: from the first on nothing
/// moves it but they, and after the second nothing does until a person says so here.
void watch_mode(FleetState& fleet, VehicleRun& run, const std::string& before, Time now) {
    const std::string& mode = run.state.operating_mode;
    if (mode != before) {
        add_event(fleet, now, "vehicle.operating_mode", {}, run.record.leg, run.record.id, {},
                  {{"from", before}, {"to", mode}});
    }
    if (is_automatic(run) || run.record.integration != Integration::kUtilise) return;
    require_person(fleet, run, {"driven_by_hand", {{"operating_mode", mode}}}, now);
}

}  // namespace

// One whose drive failed while it corrected its stop says that it does not drive, but not that the
// correction is over.
bool has_nothing_left(const StateMessage& state) {
    return state.node_states.empty() && state.edge_states.empty() && !state.driving &&
           std::none_of(state.action_states.begin(), state.action_states.end(),
                        [](const auto& action) { return action.status == ActionStatus::kRunning; });
}

bool may_tell_error(FleetState& fleet, VehicleRun& run, Time now) {
    if (now - run.errors_from >= std::chrono::minutes(1)) {
        run.errors_from = now;
        run.errors_told = 0;
    }
    if (run.errors_told > kErrorsPerMinute) return false;
    if (++run.errors_told <= kErrorsPerMinute) return true;
    add_event(fleet, now, "vehicle.errors_withheld", {}, run.record.leg, run.record.id, {},
              {{"errors_per_minute", std::int64_t{kErrorsPerMinute}}});
    return false;
}

bool is_automatic(const VehicleRun& run) { return run.state.operating_mode == "AUTOMATIC"; }

void forget_leg(FleetState& fleet, VehicleRun& run, Time now) {
    run.leg_seen = false;
    run.update_sent.reset();
    run.gave_up = true;
    if (!run.record.pose_known) return;
    drop_leg(fleet, run, now);
    JobOrder* order = fleet.orders.of(run.record.id);
    if (!order || order->current_step >= order->steps.size()) return;
    order->steps[order->current_step].state = StepState::kPending;
    fleet.store(*order);
    if (order->cancel_requested && !run.record.needs_resume) {
        abort_order(fleet, *order, order->reason, {}, now);
    }
}

bool has_foreign_order(const VehicleRun& run) {
    const StateMessage& state = run.state;
    return !run.has_leg() && run.reconciled && !state.order_id.empty() &&
           !(state.node_states.empty() && state.edge_states.empty());
}

void cancel_foreign_order(FleetState& fleet, VehicleRun& run, const std::string& actor, Time now) {
    if (is_asked(run, "cancelOrder")) return;
    Action action;
    action.type = "cancelOrder";
    add_event(fleet, now, "vehicle.foreign_order_cancelled", {}, {}, run.record.id, actor,
              {{"order", run.state.order_id}});
    send_action(fleet, run, std::move(action), now);
}

bool is_on_its_way(const VehicleRun& run) {
    if (run.leg_seen || !run.order_sent) return false;
    // One that fell silent may have got it, and have driven all of its base since.
    return !run.state_at || *run.state_at - *run.order_sent < kLongestWay;
}

void require_person(FleetState& fleet, VehicleRun& run, Reason reason, Time now) {
    if (!run.record.needs_resume) {
        run.record.needs_resume = true;
        run.record.needs_resume_reason = reason;
        Params params{{"reason", reason.code}};
        for (const auto& param : reason.params) params.push_back(param);
        add_event(fleet, now, "vehicle.needs_resume", {}, run.record.leg, run.record.id, {},
                  std::move(params));
        fleet.store(run);
    }
    JobOrder* order = fleet.orders.of(run.record.id);
    if (order && order->state == JobState::kRunning) {
        set_order_state(fleet, *order, JobState::kInterrupted, std::move(reason), {}, now);
    }
}

bool waits_for_person(const VehicleRun& run) {
    return run.record.needs_resume || run.record.paused;
}

void take_state(FleetState& fleet, VehicleRun& run, const StateMessage& state, Time now) {
    hear(fleet, run, now);
    if (is_overtaken(run, state)) return;
    run.newest_header = state.header_id;
    const StateMessage before = std::exchange(run.state, state);
    run.state_at = now;
    run.reconciled = true;
    fleet.changed_vehicles.insert(run.record.id);
    note_errors(fleet, run, before.errors, now);
    take_pose(fleet, run, before, now);
    watch_mode(fleet, run, before.operating_mode, now);
    take_action_states(fleet, run, now);
    // What it has passed is where it says to be; on that nothing is freed or measured.
    if (run.has_leg() && !is_in_doubt(run)) take_leg_progress(fleet, run, now);
    watch_foreign_order(fleet, run, now);
    if (!state.driving) settle(fleet, run, now);
    halt_or_resume(fleet, run, now);
    offer_pose_from_codes(fleet, run, now);
}

void cancel_leg(FleetState& fleet, VehicleRun& run, Time now) {
    if (!run.has_leg() || run.cancelling) return;
    run.cancelling = true;
    run.update_sent.reset();
    Action action;
    action.type = "cancelOrder";
    add_event(fleet, now, "leg.cancel_requested", run.leg().order, run.leg().id, run.record.id, {});
    send_action(fleet, run, std::move(action), now);
}

}  // namespace pulseline::fleet
