#include <algorithm>
#include <utility>

#include "core/fleet/state.hpp"

namespace pulseline::fleet {
namespace {

traffic::TileSet all_of(const std::vector<traffic::TileSet>& sets, std::size_t first) {
    traffic::TileSet all;
    for (std::size_t i = std::min(first, sets.size()); i < sets.size(); ++i) {
        all = traffic::merge(all, sets[i]);
    }
    return all;
}

void hold_restored_floor(FleetState& fleet, VehicleRun& run) {
    if (run.has_leg()) {
        run.edge_tiles = tiles_of(fleet, run, run.leg());
        fleet.tiles.try_hold(run.record.id, all_of(run.edge_tiles, run.leg().passed_nodes - 1));
    } else {
        free_floor_behind(fleet, run);
    }
}

/// Orders go on only after the person's act of design.md section 4.
void interrupt_after_restart(FleetState& fleet, Time now) {
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

void restore(FleetState& fleet, StoredFleet stored, Time now) {
    fleet.event_seq = stored.last_event_seq;
    fleet.order_number = stored.last_order_number;
    for (const auto& vehicle : fleet.plant.vehicles) {
        const auto* type = plant::find_vehicle_type(fleet.plant, vehicle.type);
        if (!type) continue;  // validate() refuses such a plant
        VehicleRun& run = fleet.vehicles[vehicle.id];
        run.vehicle = &vehicle;
        run.type = type;
        run.record.id = vehicle.id;
    }
    for (auto& order : stored.orders) fleet.orders.add(std::move(order));
    for (auto& key : stored.idempotency) fleet.idempotency[{key.client, key.key}] = std::move(key);
    for (auto& record : stored.vehicles) {
        VehicleRun* run = fleet.find(record.id);
        if (!run) continue;
        run->record = std::move(record);
        hold_restored_floor(fleet, *run);
    }
    interrupt_after_restart(fleet, now);
}

}  // namespace pulseline::fleet
