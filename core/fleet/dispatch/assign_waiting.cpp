#include "core/fleet/dispatch/assign_waiting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fleet/dispatch/cost_matching.hpp"
#include "core/fleet/dispatch/ready_for.hpp"
#include "core/fleet/dispatch/urgency.hpp"
#include "core/fleet/legs/leg_plans.hpp"
#include "core/fleet/orders/planning.hpp"
#include "core/fleet/orders/start_conditions.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/leg_request.hpp"
#include "core/fleet/vehicle/readiness.hpp"

// Free vehicles and waiting orders, solved as one assignment.
namespace pulseline::fleet {
namespace {

// What a second of driving weighs against: urgency decides who is served when vehicles are short,
// ways decide by whom.
constexpr double kPriority_s = 600;  // one step of priority
constexpr double kAge = 0.5;         // per second of waiting: nobody waits for ever
constexpr double kDueSoon_s = 3600;  // from here on the due time counts, up to kMostDue_s
constexpr double kDue = 0.25;        // per second nearer
constexpr double kMostDue_s = 1800;
constexpr double kMostUrgency_s = 1e8;
// Orders looked at in one go, the most urgent ones: bounds the work with a thousand of each.
constexpr std::size_t kMostOrders = 64;

double urgency_s(const JobOrder& order, Time now) {
    double urgency = kPriority_s * order.priority + kAge * seconds(now - order.created);
    if (order.due) {
        urgency += std::clamp(kDue * (kDueSoon_s - seconds(*order.due - now)), 0.0, kMostDue_s);
    }
    return std::clamp(urgency, -kMostUrgency_s, kMostUrgency_s);
}

bool is_free(const FleetState& fleet, const LiveVehicle& live) {
    if (live.has_leg()) return false;
    return fleet.orders.of(live.record.id) == nullptr;
}

/// How the vehicle would do the rest of the order. A station that is gone with the plant that the
/// order was made in ends it when its turn comes (start_step).
Result<OrderPlan> plan_rest_of(const FleetState& fleet, const JobOrder& order,
                               const LiveVehicle& live, Time now) {
    NewOrder rest;
    rest.vehicle = live.record.id;
    rest.planned_beside = true;
    Stations stations;
    for (std::size_t i = order.current_step; i < order.steps.size(); ++i) {
        const Step& step = order.steps[i];
        if (const auto* station = plant::find_station(fleet.plant, step.station)) {
            rest.steps.push_back({station->number, step.mode});
            stations.push_back(station);
        }
    }
    return plan_order(fleet, rest, stations, order.id, now);
}

/// Time to the order's first station on an empty floor; infinity: the vehicle cannot serve it.
double way_s(FleetState& fleet, const JobOrder& order, const LiveVehicle& live) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const Step& first = order.steps[order.current_step];
    const auto& of_class = fleet.floor.classes[live.floor.of_class];
    const auto place = of_class.motion.station_place(first.station);
    if (!place) return kNever;
    const bool any_way =
        first.mode == plant::MotionMode::kAuto || first.mode == plant::MotionMode::kLinear;
    const double table_s =
        fleet.floor.traffic.travel_s(live.floor.vehicle, static_cast<traffic::PlaceIndex>(*place));
    if (any_way && std::isfinite(table_s)) return table_s;
    const auto* station = plant::find_station(fleet.plant, first.station);
    const auto plan =
        plan_here(fleet, leg_request(fleet, live, live.record.pose, first.station, first.mode));
    if (plan) return plan->duration_s;
    if (station && plan.error().code == Errc::kNeedsPlan)
        return least_drive_s(live, live.record.pose, *station);
    return station && nearly_there(live, live.record.pose, *station) ? 0 : kNever;
}

/// Why the order has no vehicle now.
Reason why_it_waits(const FleetState& fleet, const JobOrder& order, Time now) {
    if (order.wanted_vehicle.empty()) return {"no_free_vehicle", {}};
    const LiveVehicle* live = fleet.find(order.wanted_vehicle);
    if (!live) return {"unknown_vehicle", {{"vehicle", order.wanted_vehicle.str()}}};
    if (!is_free(fleet, *live)) {
        Reason busy{"vehicle_busy", {{"vehicle", live->record.id.str()}}};
        if (const JobOrder* other = fleet.orders.of(live->record.id)) {
            busy.params.push_back({"order", "JO-" + std::to_string(other->number)});
        }
        return busy;
    }
    if (auto barred = not_ready_for(fleet, order, *live, now)) return barred->reason;
    if (auto reason = battery_bar(*live)) return *reason;
    return {"no_free_vehicle", {}};
}

/// Orders without a vehicle, those first whose vehicle was taken out under way.
std::vector<JobOrder*> waiting(FleetState& fleet) {
    std::vector<JobOrder*> orders;
    for (JobOrder* order : by_urgency(fleet, JobState::kInterrupted)) {
        if (order->assigned_vehicle.empty()) orders.push_back(order);
    }
    const auto fresh = by_urgency(fleet, JobState::kAllowedToStart);
    orders.insert(orders.end(), fresh.begin(), fresh.end());
    return orders;
}

}  // namespace

void assign_waiting(FleetState& fleet, Time now) {
    std::vector<JobOrder*> orders;
    for (JobOrder* order : waiting(fleet)) {
        if (auto waits = waits_for_condition(fleet, *order, now)) {
            set_order_reason(fleet, *order, std::move(*waits), now);
        } else {
            orders.push_back(order);
        }
    }
    if (orders.empty()) return;
    std::vector<LiveVehicle*> free;
    for (auto& [id, live] : fleet.vehicles) {
        const auto barred = not_ready(fleet, live, now);
        const bool ready = !barred || barred->by == Bar::kFeetDown;
        if (is_free(fleet, live) && ready && !battery_bar(live)) free.push_back(&live);
    }
    const std::size_t looked_at = free.empty() ? 0 : std::min(orders.size(), kMostOrders);
    CostMatrix matrix{looked_at, free.size(), {}};
    matrix.costs.assign(looked_at * free.size(), std::numeric_limits<double>::infinity());
    for (std::size_t row = 0; row < looked_at; ++row) {
        const JobOrder& order = *orders[row];
        for (std::size_t column = 0; column < free.size(); ++column) {
            const LiveVehicle& live = *free[column];
            if (!vehicle_fits(fleet, order, live)) continue;
            if (not_ready_for(fleet, order, live, now)) continue;
            matrix.at(row, column) = way_s(fleet, order, live) - urgency_s(order, now);
        }
    }
    const auto chosen = assign(matrix);
    for (std::size_t row = 0; row < orders.size(); ++row) {
        JobOrder& order = *orders[row];
        LiveVehicle* live = row < chosen.size() && chosen[row] ? free[*chosen[row]] : nullptr;
        if (!live) {
            if (order.state == JobState::kAllowedToStart) {
                set_order_reason(fleet, order, why_it_waits(fleet, order, now), now);
            }
            continue;
        }
        if (const auto plan = plan_rest_of(fleet, order, *live, now); !plan) {
            set_order_reason(fleet, order, plan.error().reason, now);
            continue;
        }
        if (!vehicle_fits(fleet, order, *live)) continue;  // its sequence got one in this round
        fleet.orders.assign(order, live->record.id);
        live->floor.next_try.reset();
        live->floor.in_vain_since.reset();
        set_order_state(fleet, order, JobState::kRunning, {}, {}, now);
    }
}

}  // namespace pulseline::fleet
