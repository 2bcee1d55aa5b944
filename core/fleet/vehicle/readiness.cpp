#include "core/fleet/vehicle/readiness.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

Params battery_params(const LiveVehicle& live, double limit_percent) {
    return {{"vehicle", live.record.id.str()},
            {"percent", live.state.battery_percent},
            {"limit_percent", limit_percent}};
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
    {Bar::kPoseVague,      true,  false, false},
    {Bar::kPoseOld,        false, false, true},
    {Bar::kNotAutomatic,   true,  true,  true},
    {Bar::kSafetyStop,     true,  true,  false},
    // Somebody stands before it: it goes on by itself when they have gone.
    {Bar::kFieldViolation, true,  false, false},
    {Bar::kFatalError,     true,  true,  false},
    {Bar::kPausesItself,   true,  true,  false},
    {Bar::kForeignOrder,   true,  false, false},
    {Bar::kBusy,           true,  false, false},
    {Bar::kLiftsMoving,    true,  false, false},
    // clang-format on
};

// What is held around a vehicle beside its way: one that is known less well finds itself first, and
// a way planned from where it was pointed to would not begin where it stands.
constexpr double kHeld_m = 0.10;
// So near to where a person said it is its pose still that word.
constexpr double kDrivenOff_m = 1;

bool rests_on_a_word(const VehicleRecord& record) {
    return record.basis && record.basis->kind == PoseBasis::Kind::kStatement &&
           record.basis->driven_m < kDrivenOff_m;
}

bool order_is_paused(const FleetState& fleet, const LiveVehicle& live) {
    const JobOrder* order = fleet.orders.of(live.record.id);
    return order && order->pause_requested;
}

bool bars(Bar bar, const FleetState& fleet, const LiveVehicle& live, Time now) {
    switch (bar) {
        case Bar::kNotIntegrated:
            return live.record.integration != Integration::kUtilise;
        case Bar::kLost:
            return live.link == Link::kNever || live.link == Link::kLost ||
                   live.link == Link::kGone;
        case Bar::kSilent:
            return !live.connected || live.link != Link::kLive;
        case Bar::kNotReported:
            return !live.reconciled;
        case Bar::kNeedsPerson:
            return live.record.needs_resume;
        case Bar::kPaused:
            return live.record.paused.has_value();
        case Bar::kOrderPaused:
            return order_is_paused(fleet, live);
        case Bar::kPoseUnknown:
            return !live.record.pose_known;
        case Bar::kPoseVague:
            return rests_on_a_word(live.record) && is_vague(live.state);
        case Bar::kPoseOld:
            return !live.state_at || (live.state.driving && now - *live.state_at > kPoseTooOld);
        case Bar::kNotAutomatic:
            return !is_automatic(live);
        case Bar::kSafetyStop:
            return live.state.e_stop != "NONE" && !live.state.e_stop.empty();
        case Bar::kFieldViolation:
            return live.state.field_violation;
        case Bar::kFatalError:
            return fatal_error(live) != nullptr;
        case Bar::kPausesItself:
            return live.state.paused;
        case Bar::kForeignOrder:
            return has_foreign_order(live);
        case Bar::kBusy:
            return live.delivery.cancelling() || live.state.driving;
        case Bar::kLiftsMoving:
            return lifts_move(live);
        case Bar::kFeetDown:
        case Bar::kLoad:
        case Bar::kBracketsRaised:
        case Bar::kWheelFault:
        case Bar::kCodesNotSeen:
            break;  // interlocks, which are asked together
    }
    return false;
}

/// What people are told of what bars a start.
Reason reason_of(Bar bar, const FleetState& fleet, const LiveVehicle& live, Time now) {
    const auto because = [&](const char* code, Params more = {}) {
        Reason reason{code, {{"vehicle", live.record.id.str()}}};
        reason.params.insert(reason.params.end(), more.begin(), more.end());
        return reason;
    };
    switch (bar) {
        case Bar::kNotIntegrated:
            return because("not_integrated", {{"level", to_string(live.record.integration)}});
        case Bar::kSilent:
            return because("vehicle_silent", {{"silent_s", seconds(silence(fleet, live, now))}});
        case Bar::kNotReported:
            return because("vehicle_not_reported");
        case Bar::kNeedsPerson:
            return because("needs_person", {{"cause", live.record.needs_resume_reason.code}});
        case Bar::kPaused:
            if (live.record.paused->actor.empty()) return because(reasons::kVehiclePaused);
            return because(reasons::kVehiclePaused, {{"actor", live.record.paused->actor}});
        case Bar::kPoseUnknown:
            return because("pose_unknown");
        case Bar::kPoseVague:
            return because("pose_vague", {{"deviation_m", live.state.deviation_range_m}});
        case Bar::kNotAutomatic:
            return because("not_automatic", {{"operating_mode", live.state.operating_mode}});
        case Bar::kSafetyStop:
            return because("vehicle_safety_stop", {{"e_stop", live.state.e_stop}});
        case Bar::kFieldViolation:
            return because("field_violation");
        case Bar::kFatalError:
            return because(reasons::kVehicleError, {{"type", fatal_error(live)->type}});
        case Bar::kPausesItself:
            return because(reasons::kVehiclePaused);
        case Bar::kForeignOrder:
            return because(reasons::kForeignOrder, {{"order", live.state.order_id}});
        case Bar::kBusy:
            return because("vehicle_busy");
        case Bar::kLiftsMoving:
            return because("lifts_moving", {{"actor", live.lift ? live.lift->actor : ""}});
        case Bar::kLost:
        case Bar::kOrderPaused:
        case Bar::kPoseOld:
            break;  // these bar no start
        case Bar::kFeetDown:
        case Bar::kLoad:
        case Bar::kBracketsRaised:
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
        case Interlock::Kind::kBracketsRaised:
            return Bar::kBracketsRaised;
        case Interlock::Kind::kWheelFault:
            return Bar::kWheelFault;
        case Interlock::Kind::kCodes:
            return Bar::kCodesNotSeen;
    }
    return Bar::kLoad;
}

}  // namespace

Duration silence(const FleetState& fleet, const LiveVehicle& live, Time now) {
    return now - live.last_heard.value_or(fleet.started);
}

bool charges_on(const LiveVehicle& live) {
    return live.state.charging && live.state.battery_percent < live.type->battery.enough_percent;
}

std::optional<Reason> battery_bar(const LiveVehicle& live) {
    if (!live.state_at) return std::nullopt;
    const plant::BatteryLimits& limits = live.type->battery;
    if (charges_on(live)) {
        return Reason{"battery_charging", battery_params(live, limits.enough_percent)};
    }
    if (live.state.battery_percent < limits.critical_percent) {
        return Reason{"battery_low", battery_params(live, limits.critical_percent)};
    }
    return std::nullopt;
}

std::optional<Barred> not_ready(const FleetState& fleet, const LiveVehicle& live, Time now) {
    for (const Condition& condition : kConditions) {
        if (!condition.bars_start || !bars(condition.bar, fleet, live, now)) continue;
        return Barred{condition.bar, reason_of(condition.bar, fleet, live, now)};
    }
    const auto lock = interlock(fleet, live);
    if (!lock) return std::nullopt;
    Reason reason{lock->reason.code, {{"vehicle", live.record.id.str()}}};
    const Params& more = lock->reason.params;
    reason.params.insert(reason.params.end(), more.begin(), more.end());
    return Barred{bar_of(lock->kind), std::move(reason)};
}

bool cannot_move(const FleetState& fleet, const LiveVehicle& live) {
    for (const Condition& condition : kConditions) {
        if (condition.bars_release && bars(condition.bar, fleet, live, {})) return true;
    }
    // On its way a platform loses sight of the codes, and forces shift: what bars a start does not
    // stop a drive, but for a broken wheel, and a load that somebody brings into its brackets' way.
    const auto lock = interlock(fleet, live);
    return lock && (!live.has_leg() || lock->kind == Interlock::Kind::kWheelFault ||
                    lock->kind == Interlock::Kind::kBracketsRaised);
}

bool bars_extension(const FleetState& fleet, const LiveVehicle& live, Time now) {
    return std::any_of(std::begin(kConditions), std::end(kConditions), [&](const Condition& one) {
        return one.bars_extension && bars(one.bar, fleet, live, now);
    });
}

// One whose drive failed while it corrected its stop says that it does not drive, but not that the
// correction is over.
bool has_nothing_left(const vda5050::StateMessage& state) {
    return state.node_states.empty() && state.edge_states.empty() && !state.driving &&
           std::none_of(state.action_states.begin(), state.action_states.end(),
                        [](const auto& action) {
                            return action.status == vda5050::ActionStatus::kRunning ||
                                   action.status == vda5050::ActionStatus::kPaused;
                        });
}

bool lifts_move(const LiveVehicle& live) {
    if (live.lift && live.lift->state == LiftMove::State::kUnderWay) return true;
    const auto& actions = live.state.action_states;
    return !live.has_leg() && std::any_of(actions.begin(), actions.end(), [](const auto& action) {
        return vda5050::is_lift(action.type) && action.status == vda5050::ActionStatus::kRunning;
    });
}

bool is_vague(const vda5050::StateMessage& state) { return state.deviation_range_m > kHeld_m; }

bool is_automatic(const LiveVehicle& live) { return live.state.operating_mode == "AUTOMATIC"; }

const vda5050::VehicleError* fatal_error(const LiveVehicle& live) {
    const auto& errors = live.state.errors;
    const auto found = std::find_if(errors.begin(), errors.end(),
                                    [](const vda5050::VehicleError& error) { return error.fatal; });
    return found == errors.end() ? nullptr : &*found;
}

bool has_foreign_order(const LiveVehicle& live) {
    const vda5050::StateMessage& state = live.state;
    return !live.has_leg() && live.reconciled && !state.order_id.empty() &&
           !(state.node_states.empty() && state.edge_states.empty());
}

bool is_on_its_way(const LiveVehicle& live) {
    const auto sent = live.delivery.on_this_connection();
    if (live.delivery.seen() || !sent) return false;
    // One that fell silent may have got it, and have driven all of its base since.
    return !live.state_at || *live.state_at - *sent < kLongestWay;
}

bool waits_for_person(const LiveVehicle& live) {
    return live.record.needs_resume || live.record.paused;
}

bool is_asked(const LiveVehicle& live, const char* action_type) {
    return std::any_of(live.actions.begin(), live.actions.end(),
                       [&](const auto& pending) { return pending.action.type == action_type; });
}

}  // namespace pulseline::fleet
