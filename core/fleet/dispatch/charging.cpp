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
bool keeps_charger(const FleetState& fleet, const VehicleRun& run) {
    return charges_on(run) || is_loaded(run) || cannot_move(fleet, run);
}

bool is_taken(const FleetState& fleet, const plant::Station& charger, const VehicleRun& by) {
    for (const auto& [id, other] : fleet.vehicles) {
        if (id == by.record.id) continue;
        if (other.has_leg() && other.leg().station == charger.id) return true;
        if (other.record.at_station == charger.id && keeps_charger(fleet, other)) return true;
    }
    return false;
}

/// Why a vehicle that should charge is not sent; none: it may be.
std::optional<Reason> may_not_charge(const VehicleRun& run, Time now) {
    const Params who{{"vehicle", run.record.id.str()}};
    if (is_loaded(run)) return Reason{"charge_loaded", who};
    if (!run.factsheet || !has(run.factsheet->node_actions, vda5050::kStartCharging)) {
        return Reason{"charge_not_announced", who};
    }
    if (run.charge_retry && now < *run.charge_retry) return Reason{"charge_failed", who};
    return std::nullopt;
}

/// Free vehicles that should charge and may be sent now.
std::vector<VehicleRun*> low_ones(FleetState& fleet, Time now) {
    std::vector<VehicleRun*> low;
    for (auto& [id, run] : fleet.vehicles) {
        const bool low_now = run.state_at && !run.state.charging &&
                             run.state.battery_percent < run.type->battery.low_percent;
        const bool free = !run.has_leg() && !fleet.orders.of(id);
        if (!low_now || !free || not_ready(fleet, run, now)) {
            run.charge_wait.reset();
            continue;
        }
        if (run.charge_wait && run.floor.next_try && now < *run.floor.next_try) continue;
        run.charge_wait = may_not_charge(run, now);
        if (!run.charge_wait) low.push_back(&run);
    }
    return low;
}

Result<Leg> leg_to_charger(FleetState& fleet, const VehicleRun& run, const plant::Station& charger,
                           LegId id) {
    if (run.record.at_station == charger.id) {
        Leg leg = build_adjust_leg(fleet, run, charger, run.record.pose, id);
        leg.nodes.front().actions.clear();
        return leg;
    }
    const auto plan = fleet.planner.plan_primitive_leg(
        leg_request(fleet, run, run.record.pose, charger.id, plant::MotionMode::kAuto));
    if (!plan) return fail(plan.error());
    return build_leg(fleet, run, *plan, charger, run.record.pose, id);
}

std::optional<Reason> go_to(FleetState& fleet, VehicleRun& run, const plant::Station& charger,
                            Time now) {
    const LegId id(fleet.ids.next(now));
    auto leg = leg_to_charger(fleet, run, charger, id);
    if (!leg) return leg.error().reason;
    leg->charges = true;
    leg->nodes.back().actions = rest_actions(fleet, run, charger, *leg);
    if (auto reason = try_leg(fleet, run, std::move(*leg), now)) return reason;
    fleet.store(run);
    add_event(fleet, now, event::kVehicleGoesCharging, {}, id, run.record.id, {},
              {{"station", std::int64_t{charger.number}}, {"percent", run.state.battery_percent}});
    send_leg(fleet, run, now);
    return std::nullopt;
}

}  // namespace

bool ends_charging(FleetState& fleet, VehicleRun& run, Time now) {
    if (!run.state.charging || !run.factsheet) return false;
    if (!has(run.factsheet->actions, vda5050::kStopCharging)) return false;
    if (!is_asked(run, vda5050::kStopCharging) && (!run.charge_retry || now >= *run.charge_retry)) {
        run.charge_retry = now + kAskAgain;
        vda5050::Action action;
        action.type = vda5050::kStopCharging;
        send_action(fleet, run, std::move(action), now);
    }
    return true;
}

void charge_failed(FleetState& fleet, VehicleRun& run, const std::string& why, Time now) {
    run.charge_retry = now + kTryAgain;
    add_event(fleet, now, event::kVehicleChargeFailed, {}, run.record.leg, run.record.id, {},
              {{"why", why}});
}

void charge_low(FleetState& fleet, Time now) {
    const std::vector<VehicleRun*> low = low_ones(fleet, now);
    if (low.empty()) return;
    std::vector<const plant::Station*> chargers;
    for (const auto& station : fleet.plant.stations) {
        if (station.charger) chargers.push_back(&station);
    }
    CostMatrix matrix{low.size(), chargers.size(), {}};
    matrix.costs.assign(low.size() * chargers.size(), std::numeric_limits<double>::infinity());
    for (std::size_t row = 0; row < low.size(); ++row) {
        const VehicleRun& run = *low[row];
        const auto& motion = fleet.floor.classes[run.floor.of_class].motion;
        for (std::size_t column = 0; column < chargers.size(); ++column) {
            const auto place = motion.station_place(chargers[column]->id);
            if (!place || is_taken(fleet, *chargers[column], run)) continue;
            matrix.at(row, column) =
                fleet.floor.traffic.travel_s(run.floor.vehicle,
                                             static_cast<traffic::PlaceIndex>(*place)) +
                kPercent_s * run.state.battery_percent;
        }
    }
    const auto chosen = assign(matrix);
    for (std::size_t row = 0; row < low.size(); ++row) {
        VehicleRun& run = *low[row];
        if (!chosen[row]) {
            run.charge_wait = Reason{"no_free_charger", {{"vehicle", run.record.id.str()}}};
        } else if (auto reason = go_to(fleet, run, *chargers[*chosen[row]], now)) {
            run.charge_wait = std::move(reason);
        }
    }
}

}  // namespace pulseline::fleet
