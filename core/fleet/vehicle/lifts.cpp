#include "core/fleet/vehicle/lifts.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/params.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr std::string_view kAll = "all";  // of them
constexpr const char* kLinkLost = "link_lost";

/// Empty: it names none.
std::string bracket_of(const StepAction& wanted) {
    const auto* name = text_param(wanted.params, "bracket");
    return name == nullptr ? std::string() : *name;
}

template <class Things>
Status has_one_named(const LiveVehicle& live, const char* code, const char* kind,
                     const std::string& wanted, const Things& things, const std::string& field) {
    std::string names(kAll);
    for (const auto& thing : things) {
        if (thing.name == wanted) return {};
        names += ", " + thing.name;
    }
    if (wanted == kAll) return {};
    const std::string& id = live.record.id.str();
    return fail(Errc::kUnreachable, code,
                "Vehicle " + id + " has no " + kind + " of that name. It has " + names + ".",
                field + "/" + kind, {{"vehicle", id}, {kind, wanted}});
}

Status has_bracket(const LiveVehicle& live, const StepAction& wanted, const std::string& field) {
    const auto& lift = live.type->bracket_lift;
    const std::string who = "The brackets of " + live.record.id.str();
    const double height_m = number_param(wanted.params, "height_m").value_or(-1);
    if (!(height_m >= 0 && height_m <= lift.stroke_m)) {
        return fail(Errc::kUnreachable, "out_of_stroke",
                    who + " reach from 0 to " + std::to_string(lift.stroke_m) + " m.",
                    field + "/height_m", {{"height_m", height_m}, {"stroke_m", lift.stroke_m}});
    }
    const double speed_mps = number_param(wanted.params, "speed_mps").value_or(lift.speed_mps);
    if (!(speed_mps > 0 && speed_mps <= lift.speed_mps)) {
        return fail(Errc::kUnreachable, "out_of_speed",
                    who + " move with " + std::to_string(lift.speed_mps) + " m/s at most.",
                    field + "/speed_mps", {{"speed_mps", speed_mps}, {"most_mps", lift.speed_mps}});
    }
    return has_one_named(live, "unknown_bracket", "bracket", bracket_of(wanted),
                         live.type->brackets, field);
}

/// What hangs above it must not be taken over by its feet.
Status may_rise_below(const FleetState& fleet, const LiveVehicle& live) {
    const auto* station = plant::find_station(fleet.plant, live.record.at_station);
    const auto* load = load_at(fleet, live.record.at_station);
    if (load == nullptr || station == nullptr || !station->support || !live.type->parking)
        return {};
    const double most_m = station->support->height_m - live.type->parking->lift_m;
    for (const auto& bracket : live.state.brackets) {
        const double height_m = bracket.height_m.value_or(0);
        if (height_m < most_m) continue;
        const std::string& id = live.record.id.str();
        return fail(
            Errc::kConflict, "brackets_too_high",
            "On its feet vehicle " + id + " would lift " + load->name +
                " that hangs or stands above its brackets. Lower these first.",
            {},
            {{"vehicle", id}, {"load", load->name}, {"height_m", height_m}, {"most_m", most_m}});
    }
    return {};
}

bool is_under_way(const LiveVehicle& live) {
    return live.lift && live.lift->state == LiftMove::State::kUnderWay;
}

Status has_them(const LiveVehicle& live, const StepAction& wanted) {
    const std::string& id = live.record.id.str();
    const bool announced =
        live.factsheet && std::ranges::find(live.factsheet->instant_actions, wanted.type) !=
                              live.factsheet->instant_actions.end();
    if (!vda5050::is_lift(wanted.type) || !announced) {
        return fail(
            Errc::kUnreachable, "unknown_lift",
            "Vehicle " + id + " does not say that it can do " + wanted.type + " outside an order.",
            "/type", {{"vehicle", id}, {"action", wanted.type}});
    }
    return has_lift(live, wanted, {});
}

}  // namespace

Status has_lift(const LiveVehicle& live, const StepAction& wanted, const std::string& field) {
    if (wanted.type == vda5050::kSetBracketHeight) {
        // Of one whose brackets the plant does not know nobody can say.
        return live.type->brackets.empty() ? Status{} : has_bracket(live, wanted, field);
    }
    const bool feet =
        wanted.type == vda5050::kLowerParking || wanted.type == vda5050::kRaiseParking;
    const auto* foot = text_param(wanted.params, "foot");
    if (!feet || foot == nullptr || !live.type->parking) return {};
    return has_one_named(live, "unknown_foot", "foot", *foot, live.type->parking->feet, field);
}

Status may_move_lifts(const FleetState& fleet, const LiveVehicle& live, const StepAction& wanted) {
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
    if (vda5050::is_transfer(wanted.type)) return may_transfer(fleet, live, wanted);
    const bool feet = wanted.type != vda5050::kSetBracketHeight;
    if (auto fault = rule_broken(live); fault && (feet || bracket_of(wanted) == kAll)) {
        return conflict(fault->code.c_str(),
                        " carries a load that breaks a rule of its type. Put "
                        "that right with single brackets first.",
                        fault->params);
    }
    if (!feet) return {};
    // On its feet the whole rises, also below what still hangs.
    if (auto fault = load_view(fleet, live).fault) {
        return conflict(fault->code.c_str(),
                        " feels other weight on its brackets than it is said to carry. Go on "
                        "with taking the load over or setting it down, or say where it is.",
                        fault->params);
    }
    return wanted.type == vda5050::kLowerParking ? may_rise_below(fleet, live) : Status{};
}

void note_lift_ended(FleetState& fleet, LiveVehicle& live, const vda5050::ActionState& answer,
                     Time now) {
    if (!is_under_way(live) || live.lift->action_id != answer.id) return;
    const bool done = answer.status == vda5050::ActionStatus::kFinished;
    live.lift->state = done ? LiftMove::State::kDone : LiftMove::State::kFailed;
    live.lift->why = answer.result_description;
    if (!done || !vda5050::is_transfer(live.lift->what.type)) return;
    note_transferred(fleet, live, live.lift->what, {live.lift->actor}, now);
}

void recall_lift(LiveVehicle& live, Time now) {
    if (live.lift || live.has_leg()) return;
    const auto& told = live.state.action_states;
    const auto broken = std::find_if(told.rbegin(), told.rend(), [](const auto& action) {
        return vda5050::is_lift(action.type);
    });
    if (broken == told.rend() || broken->status != vda5050::ActionStatus::kFailed ||
        broken->result_description != kLinkLost) {
        return;
    }
    StepAction what;
    what.type = broken->type;
    live.lift = LiftMove{std::move(what),           broken->id, {}, now, LiftMove::State::kFailed,
                         broken->result_description};
}

void give_up_lift(FleetState& fleet, LiveVehicle& live, Time now) {
    std::erase_if(live.actions, [](const PendingAction& pending) {
        return vda5050::is_lift(pending.action.type) || pending.action.type == vda5050::kStopLifts;
    });
    if (!is_under_way(live)) return;
    live.lift->state = LiftMove::State::kFailed;
    live.lift->why = kLinkLost;
    add_event(fleet, now, event::kVehicleAction, {}, {}, live.record.id, {},
              {{"action", live.lift->what.type},
               {"action_id", live.lift->action_id},
               {"status", "failed"},
               {"result", live.lift->why}});
}

}  // namespace pulseline::fleet
