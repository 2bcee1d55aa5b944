#include <utility>

#include "core/fleet/mutation.hpp"
#include "core/fleet/state.hpp"

namespace pulseline::fleet {
namespace {

/// Orders go on only after the person's act of design.md section 4.
void interrupt_after_restart(FleetState& fleet, Time now) {
    if (mutated(Mutation::kRestartNeedsNobody)) return;
    bool any_vehicle = false;
    for (const JobOrderId& id : fleet.orders.open()) {
        const JobOrder& order = *fleet.find(id);
        const plant::VehicleId vehicle =
            order.assigned_vehicle.empty() ? order.wanted_vehicle : order.assigned_vehicle;
        if (vehicle.empty()) any_vehicle = true;
        if (VehicleRun* run = fleet.find(vehicle)) {
            require_person(fleet, *run, {"server_restarted", {}}, now);
        }
    }
    for (auto& [id, run] : fleet.vehicles) {
        if (any_vehicle || run.has_leg()) {
            require_person(fleet, run, {"server_restarted", {}}, now);
        }
    }
}

}  // namespace

void take_vehicles_of_plant(FleetState& fleet) {
    for (const auto& vehicle : fleet.plant.vehicles) {
        const auto* type = plant::find_vehicle_type(fleet.plant, vehicle.type);
        if (!type) continue;  // validate() refuses such a plant
        VehicleRun& run = fleet.vehicles[vehicle.id];
        run.vehicle = &vehicle;
        run.type = type;
        run.record.id = vehicle.id;
    }
}

void restore(FleetState& fleet, StoredFleet stored, Time now) {
    fleet.event_seq = stored.last_event_seq;
    fleet.order_number = stored.last_order_number;
    take_vehicles_of_plant(fleet);
    for (auto& order : stored.orders) fleet.orders.add(std::move(order));
    for (auto& key : stored.idempotency) fleet.idempotency[{key.client, key.key}] = std::move(key);
    for (auto& record : stored.vehicles) {
        VehicleRun* run = fleet.find(record.id);
        if (!run) continue;
        run->record = std::move(record);
    }
    open_floor(fleet, now);
    restore_closures(fleet, std::move(stored.closures), now);
    interrupt_after_restart(fleet, now);
    for (auto& [id, run] : fleet.vehicles) {
        if (is_in_doubt(run)) keep_doubt(fleet, run, now);
    }
}

}  // namespace pulseline::fleet
