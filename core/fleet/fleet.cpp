#include "core/fleet/fleet.hpp"

#include <utility>

#include "core/fleet/mutation.hpp"
#include "core/fleet/start_conditions.hpp"
#include "core/fleet/state.hpp"

namespace pulseline::fleet {
namespace {

// Final orders stay in memory for this long (idempotent repeats, lists); all of them are in the
// store.
constexpr Duration kKeepFinal = std::chrono::hours(24 * 7);
// A walk over all keys of a week, so not at every tick.
constexpr Duration kSweepKeys = std::chrono::hours(1);

}  // namespace

Fleet::Fleet(const plant::Plant& plant, StoredFleet stored, std::uint64_t id_seed, Time now,
             std::shared_ptr<const PlantTables> tables)
    : state_(std::make_unique<FleetState>(plant, tables ? std::move(tables) : plant_tables(plant),
                                          id_seed, now)),
      stored_seq_(stored.last_event_seq) {
    restore_standing(*state_, stored);
    restore(*state_, std::move(stored), now);
    require_persons_for_schedules(*state_, now);
}

Fleet::~Fleet() = default;

std::shared_ptr<const PlantTables> Fleet::tables() const { return state_->tables; }

void Fleet::vehicle_connected(const plant::VehicleId& id, Time now) {
    if (VehicleRun* run = state_->find(id)) connect(*state_, *run, now);
}

void Fleet::vehicle_disconnected(const plant::VehicleId& id, Time now) {
    if (VehicleRun* run = state_->find(id)) disconnect(*state_, *run, now);
}

void Fleet::vehicle_heard(const plant::VehicleId& id, Time now) {
    if (VehicleRun* run = state_->find(id)) hear(*state_, *run, now);
}

void Fleet::vehicle_state(const plant::VehicleId& id, const StateMessage& state, Time now) {
    VehicleRun* run = state_->find(id);
    if (!run) return;
    take_state(*state_, *run, state, now);
    dispatch_for(*state_, *run, now);
}

void Fleet::vehicle_factsheet(const plant::VehicleId& id, const Factsheet& factsheet, Time now) {
    VehicleRun* run = state_->find(id);
    if (!run) return;
    run->factsheet = factsheet;
    hear(*state_, *run, now);
}

void Fleet::vehicle_message_refused(const plant::VehicleId& id, const VehicleError& error,
                                    Time now) {
    Params params{{"text", error.description}};
    for (const auto& [key, value] : error.references) params.push_back({key, value});
    add_event(*state_, now, "vehicle.message_malformed", {}, {}, id, {}, std::move(params));
}

void Fleet::vehicle_identity_conflict(const plant::VehicleId& id, Time now) {
    VehicleRun* run = state_->find(id);
    if (!run) return;
    run->connection_refused = true;
    require_person(*state_, *run, {"identity_conflict", {{"vehicle", id.str()}}}, now);
}

bool Fleet::connection_refused(const plant::VehicleId& id) const {
    const VehicleRun* run = state_->find(id);
    return run && run->connection_refused;
}

void Fleet::store_failed(const StoreFault& fault, Time now) {
    store_fault_ = fault;
    add_event(*state_, now, "store.failed", {}, {}, {}, {}, {{"cause", fault.cause}});
    state_->out.fleet_changed = true;
}

void Fleet::store_works_again(Time now) {
    if (!store_fault_) return;
    add_event(
        *state_, now, "store.recovered", {}, {}, {}, {},
        {{"cause", store_fault_->cause}, {"read_only_s", seconds(now - store_fault_->since)}});
    store_fault_.reset();
    state_->out.fleet_changed = true;
}

void Fleet::tick(Time now) {
    update_links(*state_, now);
    resend(*state_, now);
    settle_dependencies(*state_);
    run_schedules(*state_, now);
    dispatch(*state_, now);
    state_->orders.forget_ended_before(now - kKeepFinal);
    if (now - state_->keys_swept >= kSweepKeys) {
        state_->keys_swept = now;
        std::erase_if(state_->idempotency,
                      [&](const auto& entry) { return now - entry.second.at > kKeepFinal; });
    }
}

Outputs Fleet::take_outputs(Time now, bool with_views) {
    FleetState& fleet = *state_;
    for (const auto& id : fleet.orders.take_bound()) fleet.store(*fleet.find(id));
    Outputs out = std::exchange(fleet.out, {});
    take_standing(fleet, out.records);
    for (const auto& id : std::exchange(fleet.stored_orders, {})) {
        const JobOrder* order = fleet.find(id);
        if (!order) continue;
        const bool runs = order->state == JobState::kRunning;
        if (runs && mutated(Mutation::kProgressNotStored)) continue;
        out.records.orders.push_back(*order);
    }
    for (const auto& id : std::exchange(fleet.stored_vehicles, {})) {
        if (const VehicleRun* run = fleet.find(id)) out.records.vehicles.push_back(run->record);
    }
    if (!with_views) {
        fleet.changed_vehicles.clear();
        fleet.changed_stations.clear();
    }
    for (const auto& id : std::exchange(fleet.changed_vehicles, {})) {
        if (const VehicleRun* run = fleet.find(id))
            out.vehicles.push_back(view_of(fleet, *run, now));
    }
    for (const auto& id : std::exchange(fleet.changed_stations, {})) {
        const auto* station = plant::find_station(fleet.plant, id);
        if (station) out.stations.push_back(station_view(fleet, *station));
    }
    return out;
}

}  // namespace pulseline::fleet
