#include "core/fleet/dispatch/charging.hpp"

#include <algorithm>
#include <limits>

#include "core/fleet/dispatch/cost_matching.hpp"
#include "core/fleet/legs/legs.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/leg_build.hpp"
#include "core/fleet/vehicle/leg_request.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/vda5050/actions.hpp"

// Vehicles without an order whose battery is low go to chargers.
namespace pulseline::fleet {
namespace {

constexpr Duration kTryAgain = std::chrono::seconds(60);
constexpr Duration kAskAgain = std::chrono::seconds(10);
// What a second of driving weighs against: the emptier one gets the charger.
constexpr double kPercent_s = 60;

bool has(const std::vector<std::string>& actions, const char* type) {
    return std::find(actions.begin(), actions.end(), type) != actions.end();
}

/// Keeps the charger for the vehicle that stands there: it charges, or nobody can send it away.
bool keeps_charger(const FleetState& fleet, const LiveVehicle& live) {
    return charges_on(live) || is_loaded(live) || cannot_move(fleet, live);
}

bool is_taken(const FleetState& fleet, const plant::Station& charger, const LiveVehicle& by) {
    for (const auto& [id, other] : fleet.vehicles) {
        if (id == by.record.id) continue;
        if (other.has_leg() && other.leg().station == charger.id) return true;
        if (other.record.at_station == charger.id && keeps_charger(fleet, other)) return true;
    }
    return false;
}

/// Why a vehicle that should charge is not sent; none: it may be.
std::optional<Reason> may_not_charge(const LiveVehicle& live, Time now) {
    const Params who{{"vehicle", live.record.id.str()}};
    if (is_loaded(live)) return Reason{"charge_loaded", who};
    if (!live.factsheet || !has(live.factsheet->node_actions, vda5050::kStartCharging)) {
        return Reason{"charge_not_announced", who};
    }
    if (live.charge_retry && now < *live.charge_retry) return Reason{"charge_failed", who};
    return std::nullopt;
}

/// Free vehicles that should charge and may be sent now.
std::vector<LiveVehicle*> low_ones(FleetState& fleet, Time now) {
    std::vector<LiveVehicle*> low;
    for (auto& [id, live] : fleet.vehicles) {
        const bool low_now = live.state_at && !live.state.charging &&
                             live.state.battery_percent < live.type->battery.low_percent;
        const bool free = !live.has_leg() && !fleet.orders.of(id);
        if (!low_now || !free || not_ready(fleet, live, now)) {
            live.charge_wait.reset();
            continue;
        }
        if (live.charge_wait && live.floor.next_try && now < *live.floor.next_try) continue;
        live.charge_wait = may_not_charge(live, now);
        if (!live.charge_wait) low.push_back(&live);
    }
    return low;
}

Result<Leg> leg_to_charger(FleetState& fleet, const LiveVehicle& live,
                           const plant::Station& charger, LegId id) {
    if (live.record.at_station == charger.id) {
        Leg leg = build_adjust_leg(fleet, live, charger, live.record.pose, id);
        leg.nodes.front().actions.clear();
        return leg;
    }
    const auto plan = fleet.planner.plan_primitive_leg(
        leg_request(fleet, live, live.record.pose, charger.id, plant::MotionMode::kAuto));
    if (!plan) return fail(plan.error());
    return build_leg(fleet, live, *plan, charger, live.record.pose, id);
}

std::optional<Reason> go_to(FleetState& fleet, LiveVehicle& live, const plant::Station& charger,
                            Time now) {
    const LegId id(fleet.ids.next(now));
    auto leg = leg_to_charger(fleet, live, charger, id);
    if (!leg) return leg.error().reason;
    leg->charges = true;
    leg->nodes.back().actions = rest_actions(fleet, live, charger, *leg);
    if (auto reason = try_leg(fleet, live, std::move(*leg), now)) return reason;
    fleet.store(live);
    add_event(fleet, now, event::kVehicleGoesCharging, {}, id, live.record.id, {},
              {{"station", std::int64_t{charger.number}}, {"percent", live.state.battery_percent}});
    send_leg(fleet, live, now);
    return std::nullopt;
}

}  // namespace

bool ends_charging(FleetState& fleet, LiveVehicle& live, Time now) {
    if (!live.state.charging || !live.factsheet) return false;
    if (!has(live.factsheet->actions, vda5050::kStopCharging)) return false;
    if (!is_asked(live, vda5050::kStopCharging) &&
        (!live.charge_retry || now >= *live.charge_retry)) {
        live.charge_retry = now + kAskAgain;
        vda5050::Action action;
        action.type = vda5050::kStopCharging;
        send_action(fleet, live, std::move(action), now);
    }
    return true;
}

void charge_failed(FleetState& fleet, LiveVehicle& live, const std::string& why, Time now) {
    live.charge_retry = now + kTryAgain;
    add_event(fleet, now, event::kVehicleChargeFailed, {}, live.record.leg, live.record.id, {},
              {{"why", why}});
}

void charge_low(FleetState& fleet, Time now) {
    const std::vector<LiveVehicle*> low = low_ones(fleet, now);
    if (low.empty()) return;
    std::vector<const plant::Station*> chargers;
    for (const auto& station : fleet.plant.stations) {
        if (station.charger) chargers.push_back(&station);
    }
    CostMatrix matrix{low.size(), chargers.size(), {}};
    matrix.costs.assign(low.size() * chargers.size(), std::numeric_limits<double>::infinity());
    for (std::size_t row = 0; row < low.size(); ++row) {
        const LiveVehicle& live = *low[row];
        const auto& motion = fleet.floor.classes[live.floor.of_class].motion;
        for (std::size_t column = 0; column < chargers.size(); ++column) {
            const auto place = motion.station_place(chargers[column]->id);
            if (!place || is_taken(fleet, *chargers[column], live)) continue;
            matrix.at(row, column) =
                fleet.floor.traffic.travel_s(live.floor.vehicle,
                                             static_cast<traffic::PlaceIndex>(*place)) +
                kPercent_s * live.state.battery_percent;
        }
    }
    const auto chosen = assign(matrix);
    for (std::size_t row = 0; row < low.size(); ++row) {
        LiveVehicle& live = *low[row];
        if (!chosen[row]) {
            live.charge_wait = Reason{"no_free_charger", {{"vehicle", live.record.id.str()}}};
        } else if (auto reason = go_to(fleet, live, *chargers[*chosen[row]], now)) {
            live.charge_wait = std::move(reason);
        }
    }
}

}  // namespace pulseline::fleet
