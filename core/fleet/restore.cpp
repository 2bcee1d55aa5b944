#include "core/fleet/restore.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fleet/floor/closures.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/orders/recurrence.hpp"
#include "core/fleet/reports/pose.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {
namespace {

/// Orders go on only after a person's act: POST /api/v1/fleet/resume.
void interrupt_after_restart(FleetState& fleet, Time now) {
    bool any_vehicle = false;
    for (const JobOrderId& id : fleet.orders.open()) {
        const JobOrder& order = *fleet.find(id);
        const plant::VehicleId vehicle =
            order.assigned_vehicle.empty() ? order.wanted_vehicle : order.assigned_vehicle;
        if (vehicle.empty()) any_vehicle = true;
        if (LiveVehicle* live = fleet.find(vehicle)) {
            require_person(fleet, *live, {reasons::kServerRestarted, {}}, now);
        }
    }
    for (auto& [id, live] : fleet.vehicles) {
        if (any_vehicle || live.has_leg()) {
            require_person(fleet, live, {reasons::kServerRestarted, {}}, now);
        }
    }
}

/// The plant may have been imported anew: what is left of an order may name stations that are gone.
/// A leg under way is driven to its end first, see start_step.
void abort_without_station(FleetState& fleet, Time now) {
    const auto open = fleet.orders.open();  // a copy: those that are aborted leave it
    for (const JobOrderId& id : open) {
        JobOrder& order = *fleet.find(id);
        const LiveVehicle* live = fleet.find(order.assigned_vehicle);
        if (live && live->has_leg()) continue;
        for (std::size_t i = order.current_step; i < order.steps.size(); ++i) {
            const plant::StationId station = order.steps[i].station;
            if (plant::find_station(fleet.plant, station)) continue;
            abort_order(fleet, order, {"station_gone", {{"station", station.str()}}}, {}, now);
            break;
        }
    }
}

void bring_back(Time& time, Time now) { time = std::min(time, now); }

/// A time that was kept only a little too early is not kept again: six o'clock by a clock an hour
/// ahead was that day's order. By one a day ahead it was another day's, and today's is still due.
std::optional<Time> next_after(const Schedule& schedule, Duration ahead, Time now) {
    auto next = next_time(schedule.recurrence, now);
    while (next && *next < *schedule.next) {
        const auto following = next_time(schedule.recurrence, *next);
        const bool was_there = schedule.created <= *next;
        const bool kept_for_it = !following || ahead < (*following - *next) / 2;
        if (!was_there || !kept_for_it) break;
        next = following;
    }
    return next;
}

}  // namespace

void bring_back_times(FleetState& fleet, StoredFleet& stored, Time now) {
    if (stored.last_time <= now) return;
    for (auto& order : stored.orders) {
        bring_back(order.created, now);
        bring_back(order.started, now);
        bring_back(order.ended, now);
    }
    for (auto& vehicle : stored.vehicles) {
        if (vehicle.paused) bring_back(vehicle.paused->at, now);
        if (vehicle.basis) bring_back(vehicle.basis->at, now);
    }
    for (auto& load : stored.loads) bring_back(load.at, now);
    for (auto& sheet : stored.load_sheets) bring_back(sheet.at, now);
    for (auto& key : stored.idempotency) bring_back(key.at, now);
    for (auto& closure : stored.closures) bring_back(closure.created, now);
    for (auto& schedule : stored.schedules) {
        // "From now on" was said to that clock.
        if (schedule.created > now) bring_back(schedule.recurrence.from, now);
        if (schedule.next) schedule.next = next_after(schedule, stored.last_time - now, now);
        bring_back(schedule.created, now);
        fleet.standing.changed_schedules.insert(schedule.id);
    }
    for (auto& one : stored.templates) bring_back(one.created, now);
    fleet.ids.next(stored.last_time);  // ids still sort as they were made
    add_event(fleet, now, event::kClockWasAhead, {}, {}, {}, {},
              {{"ahead_s", seconds(stored.last_time - now)}});
}

void take_vehicles_of_plant(FleetState& fleet) {
    for (const auto& vehicle : fleet.plant.vehicles) {
        const auto* type = plant::find_vehicle_type(fleet.plant, vehicle.type);
        if (!type) continue;  // validate() refuses such a plant
        LiveVehicle& live = fleet.vehicles[vehicle.id];
        live.vehicle = &vehicle;
        live.type = type;
        live.record.id = vehicle.id;
    }
}

namespace {

/// What it may have driven since its row was written counts as driven: its pose is no surer.
void count_unseen_drive(LiveVehicle& live) {
    if (!live.record.basis || !live.has_leg()) return;
    const Leg& leg = live.leg();
    for (std::size_t i = 0; i < leg.edges.size(); ++i) {
        const bool may_be_driven = i + 1 >= leg.passed_nodes && i + 1 < leg.released_nodes;
        if (may_be_driven) live.record.basis->driven_m += std::abs(leg.edges[i].segment.length_m);
    }
}

}  // namespace

void restore(FleetState& fleet, StoredFleet stored, Time now) {
    fleet.order_number = stored.last_order_number;
    take_vehicles_of_plant(fleet);
    for (auto& order : stored.orders) {
        fleet.orders.add(std::move(order));
        fleet.orders.tidy(Time{});
    }
    for (auto& key : stored.idempotency) {
        if (fleet.orders.knows(key.order))
            fleet.idempotency[{key.client, key.key}] = std::move(key);
    }
    for (auto& record : stored.vehicles) {
        LiveVehicle* live = fleet.find(record.id);
        if (!live) continue;
        live->record = std::move(record);
        count_unseen_drive(*live);
    }
    restore_loads(fleet, std::move(stored.load_sheets), std::move(stored.loads), now);
    rebuild_floor(fleet, now);
    close_below_loads(fleet, now);
    restore_closures(fleet, std::move(stored.closures), now);
    interrupt_after_restart(fleet, now);
    for (auto& [id, live] : fleet.vehicles) {
        if (is_in_doubt(live)) keep_doubt(fleet, live, now);
    }
    abort_without_station(fleet, now);
}

}  // namespace pulseline::fleet
