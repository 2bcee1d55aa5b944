#include "core/fleet/vehicle/readiness.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

Params battery_params(const VehicleRun& run, double limit_percent) {
    return {{"vehicle", run.record.id.str()},
            {"percent", run.state.battery_percent},
            {"limit_percent", limit_percent}};
}

/// The next thing it does, standing, is to raise its feet.
bool raises_feet_first(const JobOrder& order) {
    if (order.current_step >= order.steps.size()) return false;
    const Step& step = order.steps[order.current_step];
    if (step.phase != StepPhase::kBefore) return false;
    const auto todo = step.before.begin() +
                      static_cast<std::ptrdiff_t>(std::min(step.actions_done, step.before.size()));
    return std::any_of(todo, step.before.end(), [](const StepAction& action) {
        return action.type == vda5050::kRaiseParking;
    });
}

constexpr Duration kLongestWay = std::chrono::seconds(10);  // of a message to a vehicle

}  // namespace

Duration silence(const FleetState& fleet, const VehicleRun& run, Time now) {
    return now - run.last_heard.value_or(fleet.started);
}

bool charges_on(const VehicleRun& run) {
    return run.state.charging && run.state.battery_percent < run.type->battery.enough_percent;
}

std::optional<Reason> battery_bar(const VehicleRun& run) {
    if (!run.state_at) return std::nullopt;
    const plant::BatteryLimits& limits = run.type->battery;
    if (charges_on(run)) {
        return Reason{"battery_charging", battery_params(run, limits.enough_percent)};
    }
    if (run.state.battery_percent < limits.critical_percent) {
        return Reason{"battery_low", battery_params(run, limits.critical_percent)};
    }
    return std::nullopt;
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
    if (run.delivery.cancelling() || run.state.driving) return because("vehicle_busy");
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

// One whose drive failed while it corrected its stop says that it does not drive, but not that the
// correction is over.
bool has_nothing_left(const vda5050::StateMessage& state) {
    return state.node_states.empty() && state.edge_states.empty() && !state.driving &&
           std::none_of(
               state.action_states.begin(), state.action_states.end(),
               [](const auto& action) { return action.status == vda5050::ActionStatus::kRunning; });
}

bool is_automatic(const VehicleRun& run) { return run.state.operating_mode == "AUTOMATIC"; }

bool has_foreign_order(const VehicleRun& run) {
    const vda5050::StateMessage& state = run.state;
    return !run.has_leg() && run.reconciled && !state.order_id.empty() &&
           !(state.node_states.empty() && state.edge_states.empty());
}

bool is_on_its_way(const VehicleRun& run) {
    const auto sent = run.delivery.on_this_connection();
    if (run.delivery.seen() || !sent) return false;
    // One that fell silent may have got it, and have driven all of its base since.
    return !run.state_at || *run.state_at - *sent < kLongestWay;
}

bool waits_for_person(const VehicleRun& run) {
    return run.record.needs_resume || run.record.paused;
}

bool is_asked(const VehicleRun& run, const char* action_type) {
    return std::any_of(run.actions.begin(), run.actions.end(),
                       [&](const auto& pending) { return pending.action.type == action_type; });
}

}  // namespace pulseline::fleet
