#include "core/fleet/vehicle/readiness.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
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

// No base is extended on an older pose while the vehicle drives.
constexpr Duration kPoseTooOld = std::chrono::seconds(2);

/// One list for all that a vehicle may be asked to do: to start a move, to obey a release of floor
/// some day, to take a longer base now. Interlocks come behind it.
struct Condition {
    Bar bar;
    bool bars_start;
    bool bars_release;
    bool bars_extension;
};
constexpr Condition kConditions[] = {
    // clang-format off
    //                     start  release  extension
    {Bar::kNotIntegrated,  true,  true,  false},
    {Bar::kLost,           false, true,  false},
    {Bar::kSilent,         true,  false, true},
    {Bar::kNotReported,    true,  true,  true},
    {Bar::kNeedsPerson,    true,  true,  true},
    {Bar::kPaused,         true,  true,  true},
    {Bar::kOrderPaused,    false, true,  false},
    {Bar::kPoseUnknown,    true,  true,  false},
    {Bar::kPoseOld,        false, false, true},
    {Bar::kNotAutomatic,   true,  true,  true},
    {Bar::kSafetyStop,     true,  true,  false},
    // Somebody stands before it: it goes on by itself when they have gone.
    {Bar::kFieldViolation, true,  false, false},
    {Bar::kFatalError,     true,  true,  false},
    {Bar::kPausesItself,   true,  true,  false},
    {Bar::kForeignOrder,   true,  false, false},
    {Bar::kBusy,           true,  false, false},
    // clang-format on
};

const vda5050::VehicleError* fatal_error(const VehicleRun& run) {
    const auto& errors = run.state.errors;
    const auto found = std::find_if(errors.begin(), errors.end(),
                                    [](const vda5050::VehicleError& error) { return error.fatal; });
    return found == errors.end() ? nullptr : &*found;
}

bool order_is_paused(const FleetState& fleet, const VehicleRun& run) {
    const JobOrder* order = fleet.orders.of(run.record.id);
    return order && order->pause_requested;
}

bool bars(Bar bar, const FleetState& fleet, const VehicleRun& run, Time now) {
    switch (bar) {
        case Bar::kNotIntegrated:
            return run.record.integration != Integration::kUtilise;
        case Bar::kLost:
            return run.link == Link::kNever || run.link == Link::kLost || run.link == Link::kGone;
        case Bar::kSilent:
            return !run.connected || run.link != Link::kLive;
        case Bar::kNotReported:
            return !run.reconciled;
        case Bar::kNeedsPerson:
            return run.record.needs_resume;
        case Bar::kPaused:
            return run.record.paused.has_value();
        case Bar::kOrderPaused:
            return order_is_paused(fleet, run);
        case Bar::kPoseUnknown:
            return !run.record.pose_known;
        case Bar::kPoseOld:
            return !run.state_at || (run.state.driving && now - *run.state_at > kPoseTooOld);
        case Bar::kNotAutomatic:
            return !is_automatic(run);
        case Bar::kSafetyStop:
            return run.state.e_stop != "NONE" && !run.state.e_stop.empty();
        case Bar::kFieldViolation:
            return run.state.field_violation;
        case Bar::kFatalError:
            return fatal_error(run) != nullptr;
        case Bar::kPausesItself:
            return run.state.paused;
        case Bar::kForeignOrder:
            return has_foreign_order(run);
        case Bar::kBusy:
            return run.delivery.cancelling() || run.state.driving;
        case Bar::kFeetDown:
        case Bar::kLoad:
        case Bar::kWheelFault:
        case Bar::kCodesNotSeen:
            break;  // interlocks, which are asked together
    }
    return false;
}

/// What people are told of what bars a start.
Reason reason_of(Bar bar, const FleetState& fleet, const VehicleRun& run, Time now) {
    const auto because = [&](const char* code, Params more = {}) {
        Reason reason{code, {{"vehicle", run.record.id.str()}}};
        reason.params.insert(reason.params.end(), more.begin(), more.end());
        return reason;
    };
    switch (bar) {
        case Bar::kNotIntegrated:
            return because("not_integrated", {{"level", to_string(run.record.integration)}});
        case Bar::kSilent:
            return because("vehicle_silent", {{"silent_s", seconds(silence(fleet, run, now))}});
        case Bar::kNotReported:
            return because("vehicle_not_reported");
        case Bar::kNeedsPerson:
            return because("needs_person", {{"cause", run.record.needs_resume_reason.code}});
        case Bar::kPaused:
            if (run.record.paused->actor.empty()) return because(reasons::kVehiclePaused);
            return because(reasons::kVehiclePaused, {{"actor", run.record.paused->actor}});
        case Bar::kPoseUnknown:
            return because("pose_unknown");
        case Bar::kNotAutomatic:
            return because("not_automatic", {{"operating_mode", run.state.operating_mode}});
        case Bar::kSafetyStop:
            return because("vehicle_safety_stop", {{"e_stop", run.state.e_stop}});
        case Bar::kFieldViolation:
            return because("field_violation");
        case Bar::kFatalError:
            return because("vehicle_error", {{"type", fatal_error(run)->type}});
        case Bar::kPausesItself:
            return because(reasons::kVehiclePaused);
        case Bar::kForeignOrder:
            return because(reasons::kForeignOrder, {{"order", run.state.order_id}});
        case Bar::kBusy:
            return because("vehicle_busy");
        case Bar::kLost:
        case Bar::kOrderPaused:
        case Bar::kPoseOld:
            break;  // these bar no start
        case Bar::kFeetDown:
        case Bar::kLoad:
        case Bar::kWheelFault:
        case Bar::kCodesNotSeen:
            break;  // an interlock says itself what it found
    }
    return {};
}

Bar bar_of(Interlock::Kind kind) {
    switch (kind) {
        case Interlock::Kind::kFeetDown:
            return Bar::kFeetDown;
        case Interlock::Kind::kLoad:
            return Bar::kLoad;
        case Interlock::Kind::kWheelFault:
            return Bar::kWheelFault;
        case Interlock::Kind::kCodes:
            return Bar::kCodesNotSeen;
    }
    return Bar::kLoad;
}

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

std::optional<Barred> not_ready(const FleetState& fleet, const VehicleRun& run, Time now) {
    for (const Condition& condition : kConditions) {
        if (!condition.bars_start || !bars(condition.bar, fleet, run, now)) continue;
        return Barred{condition.bar, reason_of(condition.bar, fleet, run, now)};
    }
    const auto lock = interlock(fleet, run);
    if (!lock) return std::nullopt;
    Reason reason{lock->reason.code, {{"vehicle", run.record.id.str()}}};
    const Params& more = lock->reason.params;
    reason.params.insert(reason.params.end(), more.begin(), more.end());
    return Barred{bar_of(lock->kind), std::move(reason)};
}

std::optional<Barred> not_ready_for(const FleetState& fleet, const JobOrder& order,
                                    const VehicleRun& run, Time now) {
    auto barred = not_ready(fleet, run, now);
    if (barred && barred->by == Bar::kFeetDown && raises_feet_first(order)) return std::nullopt;
    return barred;
}

bool cannot_move(const FleetState& fleet, const VehicleRun& run) {
    for (const Condition& condition : kConditions) {
        if (condition.bars_release && bars(condition.bar, fleet, run, {})) return true;
    }
    // On its way a platform loses sight of the codes, and forces shift: what bars a start does not
    // stop a drive, but for a broken wheel.
    const auto lock = interlock(fleet, run);
    return lock && (!run.has_leg() || lock->kind == Interlock::Kind::kWheelFault);
}

bool bars_extension(const FleetState& fleet, const VehicleRun& run, Time now) {
    return std::any_of(std::begin(kConditions), std::end(kConditions), [&](const Condition& one) {
        return one.bars_extension && bars(one.bar, fleet, run, now);
    });
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
