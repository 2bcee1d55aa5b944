#include <algorithm>

#include "core/fleet/start_conditions.hpp"
#include "core/fleet/state.hpp"
#include "core/fleet/step_actions.hpp"

// Dispatch in named phases. Optimal assignment, parking and charging become phases of their own.
namespace pulseline::fleet {
namespace {

// No base is extended on an older pose while the vehicle drives.
constexpr Duration kPoseTooOld = std::chrono::seconds(2);

bool is_free(FleetState& fleet, const VehicleRun& run) {
    return !run.has_leg() && fleet.orders.of(run.record.id) == nullptr;
}

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

NewOrder rest_of(const FleetState& fleet, const JobOrder& order) {
    NewOrder rest;
    for (const auto& step : order.steps) {
        if (const auto* station = plant::find_station(fleet.plant, step.station)) {
            rest.steps.push_back({station->number, step.mode});
        }
    }
    return rest;
}

/// The free and ready vehicle that would finish the order's first leg soonest.
VehicleRun* soonest_vehicle(FleetState& fleet, const JobOrder& order, Time now, Reason& why_not) {
    VehicleRun* best = nullptr;
    double best_s = 0;
    why_not = {"no_free_vehicle", {}};
    NewOrder rest = rest_of(fleet, order);
    for (auto& [id, run] : fleet.vehicles) {
        if (!is_free(fleet, run) || !vehicle_fits(fleet, order, run)) continue;
        if (not_ready(fleet, run, now)) continue;
        rest.vehicle = id;
        const auto plan = plan_order(fleet, rest, now);
        if (!plan) continue;
        const double time_s = plan->plans.front() ? plan->plans.front()->duration_s : 0;
        if (!best || time_s < best_s) {
            best = &run;
            best_s = time_s;
        }
    }
    return best;
}

void assign_waiting(FleetState& fleet, Time now) {
    for (JobOrder* order : by_urgency(fleet, JobState::kAllowedToStart)) {
        VehicleRun* run = nullptr;
        Reason why_not;
        if (auto waits = waits_for_condition(fleet, *order, now)) {
            why_not = std::move(*waits);
        } else if (!order->wanted_vehicle.empty()) {
            run = fleet.find(order->wanted_vehicle);
            if (!is_free(fleet, *run)) {
                const JobOrder* other = fleet.orders.of(run->record.id);
                why_not = {"vehicle_busy", {{"vehicle", run->record.id.str()}}};
                if (other)
                    why_not.params.push_back({"order", "JO-" + std::to_string(other->number)});
                run = nullptr;
            } else if (const auto reason = not_ready(fleet, *run, now)) {
                why_not = *reason;
                run = nullptr;
            }
        } else {
            run = soonest_vehicle(fleet, *order, now, why_not);
        }
        if (!run) {
            set_order_reason(fleet, *order, std::move(why_not), now);
            continue;
        }
        fleet.orders.assign(*order, run->record.id);
        set_order_state(fleet, *order, JobState::kRunning, {}, {}, now);
    }
}

traffic::TileSet all_of(const std::vector<traffic::TileSet>& sets) {
    traffic::TileSet all;
    for (const auto& set : sets) all = traffic::merge(all, set);
    return all;
}

void start_step(FleetState& fleet, JobOrder& order, VehicleRun& run, Time now) {
    Step& step = order.steps[order.current_step];
    const plant::Station* station = plant::find_station(fleet.plant, step.station);
    const LegId id(fleet.ids.next(now));
    Leg leg;
    if (auto actions = next_actions_leg(fleet, order, run, id)) {
        leg = std::move(*actions);
    } else if (nearly_there(run, run.record.pose, *station)) {
        leg = build_adjust_leg(fleet, run, *station, run.record.pose, id);
    } else {
        // The measured pose, not the theoretical one, starts the leg (Tang 2020, section 3.2).
        const auto request = leg_request(fleet, run, run.record.pose, step.station, step.mode);
        const auto& newest = fleet.newest_plan;
        const bool planned =
            newest && newest->vehicle == run.record.id && newest->request == request;
        const auto plan =
            planned ? Result<planning::LegPlan>(newest->plan) : fleet.planner.plan_leg(request);
        if (!plan) {
            set_order_state(fleet, order, JobState::kInterrupted, plan.error().reason, {}, now);
            return;
        }
        leg = build_leg(fleet, run, *plan, *station, run.record.pose, id);
    }
    leg.order = order.id;
    leg.step = static_cast<int>(order.current_step);
    leg.attempt = step.attempts + 1;
    auto tiles = tiles_of(fleet, run, leg);
    if (const auto blocker = fleet.tiles.try_hold(run.record.id, all_of(tiles))) {
        set_order_reason(fleet, order, {"floor_held", {{"vehicle", blocker->vehicle.str()}}}, now);
        return;
    }
    run.record.has_leg = true;
    run.record.leg = id;
    run.record.leg_data = std::move(leg);
    run.edge_tiles = std::move(tiles);
    run.leg_seen = false;
    run.update_sent.reset();
    run.update_sends = 0;
    run.leg_started.reset();
    step.leg = id;
    if (!run.leg().actions_only) step.state = StepState::kDriving;
    order.reason = {};
    fleet.store(order);
    fleet.store(run);
    fleet.changed_stations.insert(station->id);
    add_event(fleet, now, run.leg().actions_only ? "step.actions" : "step.started", order.id, id,
              run.record.id, {},
              {{"step", static_cast<std::int64_t>(order.current_step)},
               {"station", std::int64_t{station->number}},
               {"mode", plant::to_string(run.leg().mode)},
               {"attempt", std::int64_t{run.leg().attempt}}});
    if (run.leg().nodes.size() == 1) {
        send_order_update(fleet, run, 0, now);
    } else {
        extend_base(fleet, run, now);
    }
}

void start_steps(FleetState& fleet, Time now) {
    for (JobOrder* order : by_urgency(fleet, JobState::kRunning)) {
        VehicleRun* run = fleet.find(order->assigned_vehicle);
        if (!run || run->has_leg() || order->current_step >= order->steps.size()) continue;
        if (const auto reason = not_ready(fleet, *run, now)) {
            set_order_reason(fleet, *order, *reason, now);
            continue;
        }
        start_step(fleet, *order, *run, now);
    }
}

bool may_extend_base(const VehicleRun& run, Time now) {
    if (!run.has_leg() || !run.leg_seen || run.update_sent) return false;
    if (run.record.needs_resume || run.record.paused) return false;
    if (!run.connected || !run.reconciled || !run.state_at) return false;
    if (run.state.driving && now - *run.state_at > kPoseTooOld) return false;
    return run.state.operating_mode == "AUTOMATIC" && run.link == Link::kLive;
}

void extend_bases(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) {
        if (may_extend_base(run, now)) extend_base(fleet, run, now);
    }
}

}  // namespace

std::optional<Reason> not_ready(const FleetState& fleet, const VehicleRun& run, Time now) {
    const Params who{{"vehicle", run.record.id.str()}};
    const auto because = [&](std::string code, Params more = {}) {
        Params params = who;
        params.insert(params.end(), more.begin(), more.end());
        return Reason{std::move(code), std::move(params)};
    };
    if (!run.connected || run.link != Link::kLive) {
        return because("vehicle_silent", {{"silent_s", seconds(silence(fleet, run, now))}});
    }
    if (run.record.needs_resume) {
        return because("needs_person", {{"cause", run.record.needs_resume_reason.code}});
    }
    if (run.record.paused) return because("vehicle_paused");
    if (!run.reconciled) return because("vehicle_not_reported");
    if (!run.record.pose_known) return because("pose_unknown");
    if (run.state.operating_mode != "AUTOMATIC") {
        return because("not_automatic", {{"operating_mode", run.state.operating_mode}});
    }
    if (run.state.e_stop != "NONE" && !run.state.e_stop.empty()) {
        return because("vehicle_safety_stop", {{"e_stop", run.state.e_stop}});
    }
    for (const auto& error : run.state.errors) {
        if (error.fatal) return because("vehicle_error", {{"type", error.type}});
    }
    for (const auto& wheel : run.state.wheels) {
        if (!wheel.fault.empty()) {
            return because("wheel_fault", {{"wheel", wheel.name}, {"fault", wheel.fault}});
        }
    }
    if (run.state.paused) return because("vehicle_paused");
    if (run.cancelling || run.state.driving) return because("vehicle_busy");
    return std::nullopt;
}

void dispatch_for(FleetState& fleet, VehicleRun& run, Time now) {
    if (may_extend_base(run, now)) extend_base(fleet, run, now);
    JobOrder* order = fleet.orders.of(run.record.id);
    if (run.has_leg() || !order || order->state != JobState::kRunning) return;
    if (order->current_step >= order->steps.size()) return;
    if (!not_ready(fleet, run, now)) start_step(fleet, *order, run, now);
}

void dispatch(FleetState& fleet, Time now) {
    extend_bases(fleet, now);    // vehicles at work
    assign_waiting(fleet, now);  // vehicles free
    start_steps(fleet, now);
}

}  // namespace pulseline::fleet
