#include "core/fleet/vehicle/lifts.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr const char* kAll = "all";

/// Of setBracketHeight; empty: it names none.
std::string bracket_of(const StepAction& lift) {
    for (const Param& param : lift.params) {
        const auto* name = std::get_if<std::string>(&param.value);
        if (param.name == "bracket" && name != nullptr) return *name;
    }
    return {};
}

/// The same; not a number: it has none.
double height_of(const StepAction& lift) {
    for (const Param& param : lift.params) {
        const auto* height_m = std::get_if<double>(&param.value);
        if (param.name == "height_m" && height_m != nullptr) return *height_m;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

bool is_under_way(const LiveVehicle& live) {
    return live.lift && live.lift->state == LiftMove::State::kUnderWay;
}

Status has_them(const LiveVehicle& live, const StepAction& wanted) {
    const std::string& id = live.record.id.str();
    const auto& type = *live.type;
    const bool of_brackets = wanted.type == vda5050::kSetBracketHeight;
    const bool announced =
        live.factsheet && std::ranges::find(live.factsheet->instant_actions, wanted.type) !=
                              live.factsheet->instant_actions.end();
    if (!vda5050::is_lift(wanted.type) || !announced) {
        return fail(
            Errc::kUnreachable, "unknown_lift",
            "Vehicle " + id + " does not say that it can do " + wanted.type + " outside an order.",
            "/type", {{"vehicle", id}, {"action", wanted.type}});
    }
    if (!of_brackets) return {};
    const double stroke_m = type.bracket_lift.stroke_m;
    if (const double height_m = height_of(wanted); !(height_m >= 0 && height_m <= stroke_m)) {
        return fail(
            Errc::kUnreachable, "out_of_stroke",
            "The brackets of " + id + " reach from 0 to " + std::to_string(stroke_m) + " m.",
            "/height_m", {{"height_m", height_m}, {"stroke_m", stroke_m}});
    }
    const std::string bracket = bracket_of(wanted);
    const bool known = bracket == kAll || std::ranges::any_of(type.brackets, [&](const auto& one) {
                           return one.name == bracket;
                       });
    if (known) return {};
    std::string names = kAll;
    for (const auto& one : type.brackets) names += ", " + one.name;
    return fail(Errc::kUnreachable, "unknown_bracket",
                "Vehicle " + id + " has no bracket of that name. It has " + names + ".", "/bracket",
                {{"vehicle", id}, {"bracket", bracket}});
}

}  // namespace

Status may_move_lifts(const LiveVehicle& live, const StepAction& wanted) {
    if (Status has = has_them(live, wanted); !has) return has;
    const std::string& id = live.record.id.str();
    const auto conflict = [&](const char* code, const std::string& what, Params more = {}) {
        more.insert(more.begin(), Param{"vehicle", id});
        return fail(Errc::kConflict, code, "Vehicle " + id + what, {}, std::move(more));
    };
    if (lifts_move(live)) {
        const std::string actor = live.lift ? live.lift->actor : "";
        return conflict("lifts_moving",
                        " still moves its brackets or feet" +
                            (actor.empty() ? "" : ", as " + actor + " wanted") +
                            ". Wait for the end, or hold them.",
                        {{"actor", actor}});
    }
    if (live.record.needs_resume) {
        return conflict("needs_person", " waits for a person to let it go on.",
                        {{"cause", live.record.needs_resume_reason.code}});
    }
    if (live.record.paused || live.state.paused) {
        const std::string actor = live.record.paused ? live.record.paused->actor : "";
        return conflict(reasons::kVehiclePaused, " is paused. Resume it first.",
                        {{"actor", actor}});
    }
    if (live.has_leg() || has_foreign_order(live) || live.state.driving) {
        return conflict("vehicle_busy",
                        " has an order or drives. Its brackets and feet move when "
                        "that has ended, or as a part of it.");
    }
    const bool all = wanted.type != vda5050::kSetBracketHeight || bracket_of(wanted) == kAll;
    if (auto fault = load_view(live).fault; fault && all) {
        return conflict(fault->code.c_str(),
                        " carries a load that breaks a rule of its type. Put "
                        "that right with single brackets first.",
                        fault->params);
    }
    return {};
}

void note_lift_ended(LiveVehicle& live, const vda5050::ActionState& answer) {
    if (!is_under_way(live) || live.lift->action_id != answer.id) return;
    const bool done = answer.status == vda5050::ActionStatus::kFinished;
    live.lift->state = done ? LiftMove::State::kDone : LiftMove::State::kFailed;
    live.lift->why = answer.result_description;
}

void give_up_lift(FleetState& fleet, LiveVehicle& live, Time now) {
    std::erase_if(live.actions, [](const PendingAction& pending) {
        return vda5050::is_lift(pending.action.type) || pending.action.type == vda5050::kStopLifts;
    });
    if (!is_under_way(live)) return;
    live.lift->state = LiftMove::State::kFailed;
    live.lift->why = "link_lost";
    add_event(fleet, now, event::kVehicleAction, {}, {}, live.record.id, {},
              {{"action", live.lift->what.type},
               {"action_id", live.lift->action_id},
               {"status", "failed"},
               {"result", live.lift->why}});
}

}  // namespace pulseline::fleet
