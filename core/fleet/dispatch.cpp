#include <algorithm>

#include "core/fleet/dispatch_phases.hpp"
#include "core/fleet/interlocks.hpp"

namespace pulseline::fleet {
namespace {

/// The next thing it does, standing, is to raise its feet.
bool raises_feet_first(const JobOrder& order) {
    if (order.current_step >= order.steps.size()) return false;
    const Step& step = order.steps[order.current_step];
    if (step.phase != StepPhase::kBefore) return false;
    const auto todo = step.before.begin() +
                      static_cast<std::ptrdiff_t>(std::min(step.actions_done, step.before.size()));
    return std::any_of(todo, step.before.end(),
                       [](const StepAction& action) { return action.type == "raiseParking"; });
}

}  // namespace

std::vector<JobOrder*> by_urgency(FleetState& fleet, JobState state) {
    std::vector<JobOrder*> orders;
    for (const JobOrderId& id : fleet.orders.open()) {
        JobOrder* order = fleet.find(id);
        if (order->state == state) orders.push_back(order);
    }
    std::stable_sort(orders.begin(), orders.end(), [](const JobOrder* a, const JobOrder* b) {
        return a->priority != b->priority ? a->priority > b->priority : a->number < b->number;
    });
    return orders;
}

std::optional<Reason> not_ready(const FleetState& fleet, const VehicleRun& run, Time now) {
    const Params who{{"vehicle", run.record.id.str()}};
    const auto because = [&](std::string code, Params more = {}) {
        Params params = who;
        params.insert(params.end(), more.begin(), more.end());
        return Reason{std::move(code), std::move(params)};
    };
    if (run.record.integration != Integration::kUtilise) {
        return because("not_integrated", {{"level", to_string(run.record.integration)}});
    }
    if (!run.connected || run.link != Link::kLive) {
        return because("vehicle_silent", {{"silent_s", seconds(silence(fleet, run, now))}});
    }
    if (!run.reconciled) return because("vehicle_not_reported");
    if (run.record.needs_resume) {
        return because("needs_person", {{"cause", run.record.needs_resume_reason.code}});
    }
    if (const auto& pause = run.record.paused) {
        if (pause->actor.empty()) return because("vehicle_paused");
        return because("vehicle_paused", {{"actor", pause->actor}});
    }
    if (!run.record.pose_known) return because("pose_unknown");
    if (!is_automatic(run)) {
        return because("not_automatic", {{"operating_mode", run.state.operating_mode}});
    }
    if (run.state.e_stop != "NONE" && !run.state.e_stop.empty()) {
        return because("vehicle_safety_stop", {{"e_stop", run.state.e_stop}});
    }
    if (run.state.field_violation) return because("field_violation");
    for (const auto& error : run.state.errors) {
        if (error.fatal) return because("vehicle_error", {{"type", error.type}});
    }
    if (run.state.paused) return because("vehicle_paused");
    if (has_foreign_order(run)) return because("foreign_order", {{"order", run.state.order_id}});
    if (run.cancelling || run.state.driving) return because("vehicle_busy");
    if (const auto bar = interlock(fleet, run)) return because(bar->code, bar->params);
    return std::nullopt;
}

std::optional<Reason> not_ready_for(const FleetState& fleet, const JobOrder& order,
                                    const VehicleRun& run, Time now) {
    auto reason = not_ready(fleet, run, now);
    if (reason && reason->code == "parking_feet_down" && raises_feet_first(order)) {
        return std::nullopt;
    }
    return reason;
}

std::optional<Reason> cannot_move(const FleetState& fleet, const VehicleRun& run) {
    const auto because = [&](const char* code) {
        return Reason{code, {{"vehicle", run.record.id.str()}}};
    };
    if (run.record.integration != Integration::kUtilise) return because("not_integrated");
    const bool silent =
        run.link == Link::kNever || run.link == Link::kLost || run.link == Link::kGone;
    if (silent) return because("vehicle_silent");
    if (run.record.needs_resume) return because("needs_person");
    if (run.record.paused || run.state.paused) return because("vehicle_paused");
    const JobOrder* order = fleet.orders.of(run.record.id);
    if (order && order->pause_requested) return because("paused_by_person");
    if (!run.reconciled) return because("vehicle_not_reported");
    if (!run.record.pose_known) return because("pose_unknown");
    if (!is_automatic(run)) return because("not_automatic");
    const bool stopped = run.state.e_stop != "NONE" && !run.state.e_stop.empty();
    if (stopped) return because("vehicle_safety_stop");
    for (const auto& error : run.state.errors) {
        if (error.fatal) return because("vehicle_error");
    }
    // On its way a platform loses sight of the codes, and forces shift: what bars a start does not
    // stop a drive, but for a broken wheel.
    if (const auto bar = interlock(fleet, run);
        bar && (!run.has_leg() || bar->code == "wheel_fault")) {
        return because(bar->code.c_str());
    }
    return std::nullopt;
}

void dispatch_for(FleetState& fleet, VehicleRun& run, Time now) {
    if (may_extend_base(run, now)) extend_base(fleet, run, now);
    JobOrder* order = fleet.orders.of(run.record.id);
    if (run.has_leg() || !order || order->state != JobState::kRunning) return;
    if (order->current_step >= order->steps.size()) return;
    if (!not_ready_for(fleet, *order, run, now)) start_step(fleet, *order, run, now);
}

void dispatch(FleetState& fleet, Time now) {
    update_links(fleet, now);  // a command may be the first thing after the server stood still
    halt_those_that_cannot_move(fleet, now);
    extend_bases(fleet, now);  // vehicles at work
    release_withdrawn(fleet, now);
    assign_waiting(fleet, now);  // vehicles free
    start_steps(fleet, now);
    charge_low(fleet, now);  // vehicles without an order
    park_idle(fleet, now);
    improve_floor(fleet, now);  // vehicles that wait
    renew_expected_ends(fleet, now);
    check_whole_floor(fleet, now);
}

}  // namespace pulseline::fleet
