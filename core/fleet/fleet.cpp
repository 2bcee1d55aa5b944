#include "core/fleet/fleet.hpp"

#include <utility>

#include "core/fleet/commands/schedules.hpp"
#include "core/fleet/dispatch/dispatch.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/orders/start_conditions.hpp"
#include "core/fleet/reports/vehicle_report.hpp"
#include "core/fleet/restore.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/tables/plant_tables.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/beacons.hpp"
#include "core/fleet/vehicle/link.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/fleet/views/station_news.hpp"
#include "core/fleet/views/vehicle_views.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

// Final orders stay in memory for this long (idempotent repeats, lists); all of them are in the
// store.
constexpr Duration kKeepFinal = std::chrono::hours(24 * 7);
// A walk over all keys of a week, so not at every tick.
constexpr Duration kSweepKeys = std::chrono::hours(1);

/// Decided in the same batch before their vehicles came to wait for a person.
void withhold_orders(FleetState& fleet) {
    std::erase_if(fleet.out.messages, [&](const VehicleMessage& message) {
        return message.order && waits_for_person(*fleet.find(message.vehicle));
    });
}

}  // namespace

GuardedState::GuardedState(std::unique_ptr<FleetState> state) : state_(std::move(state)) {}

GuardedState::~GuardedState() = default;

Fleet::Fleet(std::unique_ptr<FleetState> state)
    : state_(std::move(state)), station_news_(std::make_unique<StationNews>()) {
    station_news_->begin(*state_);
}

Fleet::Fleet(const plant::Plant& plant, StoredFleet stored, std::uint64_t id_seed, Time now,
             std::shared_ptr<const PlantTables> tables)
    : Fleet(std::make_unique<FleetState>(plant, tables ? std::move(tables) : plant_tables(plant),
                                         id_seed, now)) {
    FleetState& fleet = state_.for_input();
    fleet.stored_seq = stored.last_event_seq;
    fleet.event_seq = stored.last_event_seq;
    bring_back_times(fleet, stored, now);
    restore_standing(fleet, stored);
    restore(fleet, std::move(stored), now);
    require_persons_for_schedules(fleet, now);
    station_news_->begin(fleet);
}

Fleet::~Fleet() = default;

std::shared_ptr<const PlantTables> Fleet::tables() const { return state_->tables; }

void Fleet::vehicle_connected(const plant::VehicleId& id, Time now) {
    FleetState& fleet = input<&Fleet::vehicle_connected>(now, id);
    if (LiveVehicle* live = fleet.find(id)) connect(fleet, *live, now);
}

void Fleet::vehicle_disconnected(const plant::VehicleId& id, Time now) {
    FleetState& fleet = input<&Fleet::vehicle_disconnected>(now, id);
    if (LiveVehicle* live = fleet.find(id)) disconnect(fleet, *live, now);
}

void Fleet::vehicle_heard(const plant::VehicleId& id, Time now) {
    FleetState& fleet = input<&Fleet::vehicle_heard>(now, id);
    if (LiveVehicle* live = fleet.find(id)) note_heard(fleet, *live, now);
}

void Fleet::vehicle_state(const plant::VehicleId& id, const vda5050::StateMessage& state,
                          Time now) {
    FleetState& fleet = input<&Fleet::vehicle_state>(now, id, state);
    LiveVehicle* live = fleet.find(id);
    if (!live) return;
    if (live->record.integration == Integration::kIgnore) return note_heard(fleet, *live, now);
    handle_state(fleet, *live, state, now);
    dispatch_for(fleet, *live, now);
}

void Fleet::vehicle_factsheet(const plant::VehicleId& id, const vda5050::Factsheet& factsheet,
                              Time now) {
    FleetState& fleet = input<&Fleet::vehicle_factsheet>(now, id, factsheet);
    LiveVehicle* live = fleet.find(id);
    if (!live) return;
    live->factsheet = factsheet;
    note_heard(fleet, *live, now);
    tell_beacons(fleet, *live, now);
}

void Fleet::vehicle_message_refused(const plant::VehicleId& id, const vda5050::VehicleError& error,
                                    Time now) {
    FleetState& fleet = input<&Fleet::vehicle_message_refused>(now, id, error);
    LiveVehicle* live = fleet.find(id);
    if (!live || !may_tell_error(fleet, *live, now)) return;
    Params params{{"text", error.description}};
    for (const auto& [key, value] : error.references) params.push_back({key, value});
    add_event(fleet, now, event::kVehicleMessageMalformed, {}, {}, id, {}, std::move(params));
}

void Fleet::vehicle_identity_conflict(const plant::VehicleId& id, Time now) {
    FleetState& fleet = input<&Fleet::vehicle_identity_conflict>(now, id);
    LiveVehicle* live = fleet.find(id);
    if (!live) return;
    live->connection_refused = true;
    require_person(fleet, *live, {reasons::kIdentityConflict, {{"vehicle", id.str()}}}, now);
}

bool Fleet::connection_refused(const plant::VehicleId& id) const {
    const LiveVehicle* live = state_->find(id);
    return live && live->connection_refused;
}

void Fleet::store_failed(const StoreFault& fault, Time now) {
    FleetState& fleet = input<&Fleet::store_failed>(now, fault);
    fleet.store_fault = fault;
    add_event(fleet, now, event::kStoreFailed, {}, {}, {}, {}, {{"cause", fault.cause}});
    fleet.out.fleet_changed = true;
}

void Fleet::store_works_again(Time now) {
    FleetState& fleet = input<&Fleet::store_works_again>(now);
    if (!fleet.store_fault) return;
    add_event(fleet, now, event::kStoreRecovered, {}, {}, {}, {},
              {{"cause", fleet.store_fault->cause},
               {"read_only_s", seconds(now - fleet.store_fault->since)}});
    const Time since = fleet.store_fault->since;
    fleet.store_fault.reset();
    fleet.out.fleet_changed = true;
    // Nobody listened meanwhile: silence counts from now on. Who was gone could not come back.
    for (auto& [id, live] : fleet.vehicles) {
        if (live.connected) {
            live.last_heard = now;
        } else if (live.last_heard) {
            live.last_heard = std::min(now, *live.last_heard + (now - since));
        }
    }
}

void Fleet::commands_expired(const std::vector<plant::VehicleId>& vehicles,
                             const std::vector<JobOrderId>& orders, Time now) {
    FleetState& fleet = input<&Fleet::commands_expired>(now, vehicles, orders);
    const Reason reason{reasons::kCommandExpired, {}};
    const auto stand = [&](LiveVehicle& live) {
        // It has not been told to go on, and is not now.
        if (is_asked(live, vda5050::kStopPause)) {
            live.record.paused = Pause{{}, now, false};
            fleet.store(live);
            pause_motion(fleet, live, vda5050::kStartPause, now);
        }
        require_person(fleet, live, reason, now);
    };
    for (const auto& id : vehicles) {
        if (LiveVehicle* live = fleet.find(id)) stand(*live);
    }
    for (const auto& id : orders) {
        JobOrder* order = fleet.find(id);
        if (!order || is_final(order->state)) continue;
        LiveVehicle* live = fleet.find(order->assigned_vehicle);
        if (live) stand(*live);
        if (order->state == JobState::kAllowedToStart) {
            set_order_state(fleet, *order, JobState::kNotAllowedToStart, reason, {}, now);
        }
    }
}

void Fleet::server_stood_still(Time since, Time now) {
    FleetState& fleet = input<&Fleet::server_stood_still>(now, since);
    add_event(fleet, now, event::kServerStoodStill, {}, {}, {}, {},
              {{"for_s", seconds(now - since)}});
    for (auto& [id, live] : fleet.vehicles) {
        if (!live.last_heard) continue;
        // What a live vehicle said meanwhile lies unread. Who was silent before stays it.
        const bool was_live = live.connected && live.link == Link::kLive;
        live.last_heard = was_live ? now : std::min(now, *live.last_heard + (now - since));
        // Where it stands now is not known before it says so.
        live.reconciled = false;
        fleet.changed_vehicles.insert(id);
    }
}

void Fleet::clock_differs(Duration ahead, Time now) {
    FleetState& fleet = input<&Fleet::clock_differs>(now, ahead);
    const Time since = fleet.clock_difference ? fleet.clock_difference->since : now;
    fleet.clock_difference = ClockDifference{ahead, since};
    add_event(fleet, now, event::kClockDiffers, {}, {}, {}, {}, {{"ahead_s", seconds(ahead)}});
    fleet.out.fleet_changed = true;
}

void Fleet::clock_agrees(Time now) {
    FleetState& fleet = input<&Fleet::clock_agrees>(now);
    if (!fleet.clock_difference) return;
    add_event(fleet, now, event::kClockAgrees, {}, {}, {}, {},
              {{"differed_s", seconds(now - fleet.clock_difference->since)}});
    fleet.clock_difference.reset();
    fleet.out.fleet_changed = true;
}

void Fleet::tick(Time now) {
    FleetState& fleet = input<&Fleet::tick>(now);
    update_links(fleet, now);
    resend(fleet, now);
    settle_dependencies(fleet);
    run_schedules(fleet, now);
    dispatch(fleet, now);
    fleet.orders.tidy(now - kKeepFinal);
    if (now - fleet.keys_swept >= kSweepKeys) {
        fleet.keys_swept = now;
        // The answer is the order, so a key is worth nothing without it.
        std::erase_if(fleet.idempotency, [&](const auto& entry) {
            const auto& [client_and_key, answer] = entry;
            return now - answer.at > kKeepFinal || !fleet.orders.knows(answer.order);
        });
    }
}

Outputs Fleet::take_outputs(Time now) {
    FleetState& fleet = input<&Fleet::take_outputs>(now);
    for (const auto& id : fleet.orders.take_bound()) fleet.store(*fleet.find(id));
    withhold_orders(fleet);
    Outputs out = std::exchange(fleet.out, {});
    take_standing(fleet, out.records);
    for (const auto& id : std::exchange(fleet.stored_orders, {})) {
        const JobOrder* order = fleet.find(id);
        if (!order) continue;
        out.records.orders.push_back(*order);
    }
    for (const auto& id : std::exchange(fleet.stored_vehicles, {})) {
        if (const LiveVehicle* live = fleet.find(id)) out.records.vehicles.push_back(live->record);
    }
    for (const auto& id : std::exchange(fleet.stored_loads, {})) {
        out.records.loads.push_back(fleet.loads.at(id));
    }
    for (const auto& id : std::exchange(fleet.stored_load_sheets, {})) {
        out.records.load_sheets.push_back(fleet.load_sheets.at(id));
    }
    const auto changed = std::exchange(fleet.changed_vehicles, {});
    auto stations = std::exchange(fleet.changed_stations, {});
    if (with_views_) {
        for (const auto& id : changed) {
            if (const LiveVehicle* live = fleet.find(id))
                out.vehicles.push_back(view_of(fleet, *live, now));
        }
        stations.merge(station_news_->of(fleet, changed));
        for (const auto& id : stations) {
            const auto* station = plant::find_station(fleet.plant, id);
            if (station) out.stations.push_back(station_view(fleet, *station));
        }
    }
    for (const auto& id : std::exchange(fleet.plans_wanted, {})) {
        const auto& awaited = fleet.find(id)->awaited_plan;
        if (!awaited) continue;
        out.plans_wanted.push_back({awaited->question, id, awaited->request, closed_floors(),
                                    standing_bodies(fleet, awaited->request.hall, id),
                                    fleet.tables});
    }
    return out;
}

void Fleet::leg_planned(const plant::VehicleId& id, std::int64_t question,
                        const LegPlanAnswer& answer, Time now) {
    FleetState& fleet = input<&Fleet::leg_planned>(now, id, question, answer);
    LiveVehicle* live = fleet.find(id);
    // Whoever asked may want to go elsewhere meanwhile, or floor was closed.
    if (!live || !live->awaited_plan || live->awaited_plan->question != question) return;
    auto& known = live->awaited_plan->answer;
    if (!known || answer.plan) {
        known = answer;
        live->newest_plan.reset();
    }
    dispatch_for(fleet, *live, now);
}

}  // namespace pulseline::fleet
