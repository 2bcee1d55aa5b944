#include "core/fleet/dispatch/start_steps.hpp"

#include "core/fleet/dispatch/charging.hpp"
#include "core/fleet/dispatch/urgency.hpp"
#include "core/fleet/floor/admission.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/legs/leg_plans.hpp"
#include "core/fleet/legs/legs.hpp"
#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/orders/planning.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/leg_build.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"

namespace pulseline::fleet {
namespace {

// So long an order may try in vain before younger ones for the same floor wait for it.
constexpr Duration kElder = std::chrono::seconds(60);

Result<planning::LegPlan> plan_step(FleetState& fleet, VehicleRun& run, const Step& step,
                                    Time now) {
    // The measured pose, not the theoretical one, starts the leg (Tang 2020, section 3.2).
    auto request = leg_request(fleet, run, run.record.pose, step.station, step.mode);
    ask_anew(fleet, run, now);
    if (!run.newest_plan || run.newest_plan->request != request) {
        auto plan = plan_or_ask(fleet, run, request, now);
        if (!plan) return plan;
        run.newest_plan = PlannedLeg{std::move(request), std::move(*plan)};
    }
    return run.newest_plan->plan;
}

Result<Leg> leg_to(FleetState& fleet, VehicleRun& run, const Step& step, LegId id, Time now) {
    const auto plan = plan_step(fleet, run, step, now);
    if (!plan) return fail(plan.error());
    const plant::Station* station = plant::find_station(fleet.plant, step.station);
    return build_leg(fleet, run, *plan, *station, run.record.pose, id);
}

/// A station that closed floor cuts off: what would have to be reopened, not just the first of it.
void name_what_cuts_off(FleetState& fleet, VehicleRun& run, const Step& step, Reason& reason,
                        Time now) {
    if (reason.code != "floor_closed") return;
    const auto plan = plan_step(fleet, run, step, now);
    if (plan) name_closures(fleet, plan->closures, reason);
}

bool waits_to_try(const VehicleRun& run, Time now) {
    return run.floor.next_try && now < *run.floor.next_try;
}

const traffic::TileSet* stand_at_goal(const FleetState& fleet, const VehicleRun& run,
                                      const JobOrder& order) {
    if (order.current_step >= order.steps.size()) return nullptr;
    const FloorClass& of_class = fleet.floor.classes[run.floor.of_class];
    const auto place = of_class.motion.station_place(order.steps[order.current_step].station);
    return place ? &of_class.stands[*place] : nullptr;
}

bool goes_before(const JobOrder& a, const JobOrder& b) {
    return a.priority != b.priority ? a.priority > b.priority : a.number < b.number;
}

/// The first order of those before this one that has waited long for the floor where this one wants
/// to go: as long as younger ones take it in turn, the elder's turn need never come.
const JobOrder* elder_of(const FleetState& fleet, const JobOrder& order, const VehicleRun& run,
                         Time now) {
    const auto* stand = stand_at_goal(fleet, run, order);
    // Who stands there already, for another approach, is done the sooner.
    const bool there = run.record.at_station == order.steps[order.current_step].station;
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

/// Gives up a leg that leads no further; the vehicle gets one of its own from where it stands.
bool leave_dead_end(FleetState& fleet, VehicleRun& run, Time now) {
    if (run.delivery.cancelling() || !run.delivery.seen() || run.delivery.unconfirmed())
        return false;
    if (cannot_move(fleet, run) || !is_dead_end(fleet, run)) return false;
    cancel_leg(fleet, run, now);
    return true;
}

/// Nothing of the leg was sent yet, and its plan was given up so that others can pass. One that
/// would have left has nobody to leave for any more; beside all places traffic finds no way back,
/// and the step begins anew.
bool drop_unsent(FleetState& fleet, VehicleRun& run, Time now) {
    const Leg& leg = run.leg();
    if (run.delivery.cancelling() || leg.nodes.size() > 1 || !leg.nodes.front().actions.empty())
        return false;
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    if (plan.last() > plan.passed) return false;
    if (!leg.order.empty() && plan.place != traffic::kNoPlace) return false;
    end_leg(fleet, run, LegEnd::kUnsent, now);
    return true;
}

/// A leg that outlived a restart has its base only; the rest of it is planned again.
void plan_rest(FleetState& fleet, VehicleRun& run, Time now) {
    if (run.floor.leg_planned || run.delivery.cancelling() || waits_to_try(run, now)) return;
    if (run.leg().nodes.size() < 2 || cannot_move(fleet, run)) return;
    if (!run.delivery.seen() || run.delivery.unconfirmed()) return;
    const bool had_horizon = run.leg().nodes.size() > run.leg().released_nodes;
    const bool had_stop = !run.leg().nodes.back().actions.empty();
    const auto reason = plan_on_floor(fleet, run, now);
    if (reason && is_stuck(fleet, run)) {
        cancel_leg(fleet, run, now);
        return;
    }
    // It ends where its base ends. The vehicle waits for more, and nodes it has take no stop any
    // more: it gives up the leg and gets one of its own for the rest.
    const bool ends_here = run.leg().nodes.size() == run.leg().released_nodes;
    const bool stops_now = !had_stop && !run.leg().nodes.back().actions.empty();
    if (!reason && ends_here && (had_horizon || stops_now)) {
        run.leg().nodes.back().actions.clear();
        cancel_leg(fleet, run, now);
        return;
    }
    JobOrder* order = fleet.find(run.leg().order);
    if (order && order->state == JobState::kRunning) {
        set_order_reason(fleet, *order, reason.value_or(Reason{}), now);
    }
}

}  // namespace

void start_step(FleetState& fleet, JobOrder& order, VehicleRun& run, Time now) {
    if (waits_to_try(run, now)) return;
    if (const JobOrder* elder = elder_of(fleet, order, run, now)) {
        set_order_reason(fleet, order,
                         {reasons::kGoesFirst,
                          {{"vehicle", elder->assigned_vehicle.str()},
                           {"order", "JO-" + std::to_string(elder->number)}}},
                         now);
        return;
    }
    if (ends_charging(fleet, run, now)) {
        set_order_reason(fleet, order, {"ends_charging", {{"vehicle", run.record.id.str()}}}, now);
        return;
    }
    Step& step = order.steps[order.current_step];
    const plant::Station* station = plant::find_station(fleet.plant, step.station);
    if (!station) {  // gone with the plant that it was ordered in
        const Reason gone{"station_gone", {{"station", step.station.str()}}};
        return abort_order(fleet, order, gone, {}, now);
    }
    const LegId id(fleet.ids.next(now));
    auto actions = next_actions_leg(fleet, order, run, id);
    const bool corrects = !actions && nearly_there(run, run.record.pose, *station);
    auto leg = actions    ? Result<Leg>(std::move(*actions))
               : corrects ? Result<Leg>(build_adjust_leg(fleet, run, *station, run.record.pose, id))
                          : leg_to(fleet, run, step, id, now);
    if (!leg && leg.error().code == Errc::kNeedsPlan) {
        return set_order_reason(fleet, order, leg.error().reason, now);
    }
    if (!leg) {
        set_order_state(fleet, order, JobState::kInterrupted, leg.error().reason, {}, now);
        return;
    }
    leg->order = order.id;
    leg->step = static_cast<int>(order.current_step);
    leg->attempt = step.attempts + 1;
    if (auto reason = try_leg(fleet, run, std::move(*leg), now)) {
        name_what_cuts_off(fleet, run, step, *reason, now);
        set_order_reason(fleet, order, *reason, now);
        return;
    }
    if (corrects) hold_for_correction(fleet, run, station->pose, now);
    run.newest_plan.reset();  // it was for the tries
    run.awaited_plan.reset();
    step.leg = id;
    if (!run.leg().actions_only) step.state = StepState::kDriving;
    order.reason = {};
    fleet.store(order);
    fleet.store(run);
    add_event(fleet, now, run.leg().actions_only ? event::kStepActions : event::kStepStarted,
              order.id, id, run.record.id, {},
              {{"step", static_cast<std::int64_t>(order.current_step)},
               {"station", std::int64_t{station->number}},
               {"mode", plant::to_string(run.leg().mode)},
               {"attempt", std::int64_t{run.leg().attempt}}});
    send_leg(fleet, run, now);
}

void start_steps(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) {
        if (!run.has_leg() || drop_unsent(fleet, run, now)) continue;
        if (!leave_dead_end(fleet, run, now)) plan_rest(fleet, run, now);
    }
    for (JobOrder* order : by_urgency(fleet, JobState::kRunning)) {
        VehicleRun* run = fleet.find(order->assigned_vehicle);
        if (!run || run->has_leg() || order->current_step >= order->steps.size()) continue;
        if (const auto barred = not_ready_for(fleet, *order, *run, now)) {
            set_order_reason(fleet, *order, barred->reason, now);
            continue;
        }
        start_step(fleet, *order, *run, now);
    }
}

}  // namespace pulseline::fleet
