#include "core/fleet/dispatch/start_steps.hpp"

#include "core/fleet/dispatch/charging.hpp"
#include "core/fleet/dispatch/ready_for.hpp"
#include "core/fleet/dispatch/step_leg.hpp"
#include "core/fleet/dispatch/urgency.hpp"
#include "core/fleet/floor/admission.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/legs/legs.hpp"
#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/orders/station_defaults.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"

namespace pulseline::fleet {
namespace {

// So long an order may try in vain before younger ones for the same floor wait for it.
constexpr Duration kElder = std::chrono::seconds(60);
// So long a leg of which nothing was sent keeps its vehicle when its plan was given up.
constexpr Duration kRelent = std::chrono::seconds(10);

bool waits_to_try(const LiveVehicle& live, Time now) {
    return live.floor.next_try && now < *live.floor.next_try;
}

const traffic::TileSet* stand_at_goal(const FleetState& fleet, const LiveVehicle& live,
                                      const JobOrder& order) {
    if (order.current_step >= order.steps.size()) return nullptr;
    const FloorClass& of_class = fleet.floor.classes[live.floor.of_class];
    const auto place = of_class.motion.station_place(order.steps[order.current_step].station);
    return place ? &of_class.stands[*place] : nullptr;
}

bool goes_before(const JobOrder& a, const JobOrder& b) {
    return a.priority != b.priority ? a.priority > b.priority : a.number < b.number;
}

/// The first order of those before this one that has waited long for the floor where this one wants
/// to go: as long as younger ones take it in turn, the elder's turn need never come.
const JobOrder* elder_of(const FleetState& fleet, const JobOrder& order, const LiveVehicle& live,
                         Time now) {
    const auto* stand = stand_at_goal(fleet, live, order);
    // Who stands there already, for another approach, is done the sooner.
    const bool there = live.record.at_station == order.steps[order.current_step].station;
    if (!stand || there) return nullptr;
    for (const auto& [id, other] : fleet.vehicles) {
        if (!other.floor.in_vain_since || now - *other.floor.in_vain_since < kElder) continue;
        const JobOrder* elder = fleet.orders.of(id);
        if (!tries_in_vain(fleet, other) || !goes_before(*elder, order)) continue;
        const auto* wanted = stand_at_goal(fleet, other, *elder);
        if (wanted && traffic::overlap(*stand, *wanted)) return elder;
    }
    return nullptr;
}

/// That is on the support there, where a vehicle with a load of its own would run into it; nullptr:
/// none.
const plant::Load* load_at_goal(const FleetState& fleet, const JobOrder& order,
                                const LiveVehicle& live, const plant::Station& station) {
    const bool is_there = live.record.at_station == station.id;
    if (!is_loaded(live) || is_there || acts_next(order, live)) return nullptr;
    return load_at(fleet, station.id);
}

/// Gives up a leg that leads no further; the vehicle gets one of its own from where it stands.
bool leave_dead_end(FleetState& fleet, LiveVehicle& live, Time now) {
    if (live.delivery.cancelling() || !live.delivery.seen() || live.delivery.unconfirmed())
        return false;
    if (cannot_move(fleet, live) || !is_dead_end(fleet, live)) return false;
    cancel_leg(fleet, live, now);
    return true;
}

/// Nothing of the leg was sent yet, and its plan was given up so that others can pass. One that
/// would have left has nobody to leave for any more, or works on here until somebody comes; beside
/// all places traffic finds no way back, and the step begins anew. At a place traffic looks for
/// another way; where there is none for long the vehicle may itself stand in the way of who bars
/// it, and only without a leg it makes way.
bool drop_unsent(FleetState& fleet, LiveVehicle& live, Time now) {
    const Leg& leg = live.leg();
    if (live.delivery.cancelling() || leg.nodes.size() > 1 || !leg.nodes.front().actions.empty())
        return false;
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    const bool works_here = leg.order.empty() && plan.last() > plan.passed &&
                            plan.at(plan.passed + 1).visit != traffic::kNoVisit;
    if (plan.last() > plan.passed && !works_here) {
        live.floor.in_vain_since.reset();
        return false;
    }
    if (!leg.order.empty() && plan.place != traffic::kNoPlace) {
        if (!live.floor.in_vain_since) live.floor.in_vain_since = now;
        if (now - *live.floor.in_vain_since < kRelent) return false;
    }
    end_leg(fleet, live, LegEnd::kUnsent, now);
    return true;
}

/// A leg that outlived a restart has its base only; the rest of it is planned again.
void plan_rest(FleetState& fleet, LiveVehicle& live, Time now) {
    if (live.floor.leg_planned || live.delivery.cancelling() || waits_to_try(live, now)) return;
    if (live.leg().nodes.size() < 2 || cannot_move(fleet, live)) return;
    if (!live.delivery.seen() || live.delivery.unconfirmed()) return;
    const bool had_horizon = live.leg().nodes.size() > live.leg().released_nodes;
    const bool had_stop = !live.leg().nodes.back().actions.empty();
    const auto reason = plan_on_floor(fleet, live, now);
    if (reason && is_stuck(fleet, live)) {
        cancel_leg(fleet, live, now);
        return;
    }
    // It ends where its base ends. The vehicle waits for more, and nodes it has take no stop any
    // more: it gives up the leg and gets one of its own for the rest.
    const bool ends_here = live.leg().nodes.size() == live.leg().released_nodes;
    const bool stops_now = !had_stop && !live.leg().nodes.back().actions.empty();
    if (!reason && ends_here && (had_horizon || stops_now)) {
        live.leg().nodes.back().actions.clear();
        cancel_leg(fleet, live, now);
        return;
    }
    JobOrder* order = fleet.find(live.leg().order);
    if (order && order->state == JobState::kRunning) {
        set_order_reason(fleet, *order, reason.value_or(Reason{}), now);
    }
}

}  // namespace

void start_step(FleetState& fleet, JobOrder& order, LiveVehicle& live, Time now) {
    if (waits_to_try(live, now)) return;
    if (const JobOrder* elder = elder_of(fleet, order, live, now)) {
        set_order_reason(fleet, order,
                         {reasons::kGoesFirst,
                          {{"vehicle", elder->assigned_vehicle.str()},
                           {"order", "JO-" + std::to_string(elder->number)}}},
                         now);
        return;
    }
    if (ends_charging(fleet, live, now)) {
        set_order_reason(fleet, order, {"ends_charging", {{"vehicle", live.record.id.str()}}}, now);
        return;
    }
    raise_parked(fleet, order, live);
    Step& step = order.steps[order.current_step];
    const plant::Station* station = plant::find_station(fleet.plant, step.station);
    if (!station) {  // gone with the plant that it was ordered in
        const Reason gone{"station_gone", {{"station", step.station.str()}}};
        return abort_order(fleet, order, gone, {}, now);
    }
    const auto waits = prepare_transfer(fleet, order, live, now);
    if (!waits) {
        set_order_state(fleet, order, JobState::kInterrupted, waits.error().reason, {}, now);
        return;
    }
    if (*waits) return set_order_reason(fleet, order, **waits, now);
    if (const auto* there = load_at_goal(fleet, order, live, *station)) {
        set_order_reason(fleet, order,
                         {"station_has_load",
                          {{"station", std::int64_t{station->number}}, {"load", there->name}}},
                         now);
        return;
    }
    const LegId id(fleet.ids.next(now));
    auto leg = leg_of_step(fleet, order, live, *station, id, now);
    if (!leg && leg.error().code == Errc::kNeedsPlan) {
        return set_order_reason(fleet, order, leg.error().reason, now);
    }
    if (!leg) {
        set_order_state(fleet, order, JobState::kInterrupted, leg.error().reason, {}, now);
        return;
    }
    leg->leg.order = order.id;
    leg->leg.step = static_cast<int>(order.current_step);
    leg->leg.attempt = step.attempts + 1;
    if (auto reason = try_leg(fleet, live, std::move(leg->leg), now)) {
        name_what_cuts_off(fleet, live, step, *reason, now);
        set_order_reason(fleet, order, *reason, now);
        return;
    }
    if (leg->corrects) hold_for_correction(fleet, live, station->pose, now);
    live.newest_plan.reset();  // it was for the tries
    live.awaited_plan.reset();
    step.leg = id;
    if (!live.leg().actions_only) step.state = StepState::kDriving;
    order.reason = {};
    fleet.store(order);
    fleet.store(live);
    add_event(fleet, now, live.leg().actions_only ? event::kStepActions : event::kStepStarted,
              order.id, id, live.record.id, {},
              {{"step", static_cast<std::int64_t>(order.current_step)},
               {"station", std::int64_t{station->number}},
               {"mode", plant::to_string(live.leg().mode)},
               {"attempt", std::int64_t{live.leg().attempt}}});
    send_leg(fleet, live, now);
}

void start_steps(FleetState& fleet, Time now) {
    for (auto& [id, live] : fleet.vehicles) {
        if (!live.has_leg() || drop_unsent(fleet, live, now)) continue;
        if (!leave_dead_end(fleet, live, now)) plan_rest(fleet, live, now);
    }
    for (JobOrder* order : by_urgency(fleet, JobState::kRunning)) {
        LiveVehicle* live = fleet.find(order->assigned_vehicle);
        if (!live || live->has_leg() || order->current_step >= order->steps.size()) continue;
        if (const auto barred = not_ready_for(fleet, *order, *live, now)) {
            set_order_reason(fleet, *order, barred->reason, now);
            continue;
        }
        start_step(fleet, *order, *live, now);
    }
}

}  // namespace pulseline::fleet
