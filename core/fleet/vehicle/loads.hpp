#pragma once

#include <vector>

#include "core/base/result.hpp"
#include "core/fleet/state/fleet_state.hpp"

/// Where the loads are: aircraft, products, instruments (Tang 2020, section 2: workflow of taking
/// an aircraft over). Each is in one place, and no place has two.
namespace pulseline::fleet {

/// What is known of each load: as stored, the others as the plant has them. Where each is: as
/// stored, or where nothing is stored, or the plant forbids it there by now, as the plant has it at
/// first (event load.moved).
void restore_loads(FleetState& fleet, std::vector<LoadSheet> sheets, std::vector<LoadRecord> places,
                   Time now);
/// nullptr: nobody knows it, or it has left for ever. Lives until it is retired.
const plant::Load* find_load(const FleetState& fleet, const plant::LoadId& id);
/// What each vehicle holds floor with follows from the loads (LiveVehicle::load).
void find_loads(FleetState& fleet);

/// That the action names; empty: none.
plant::LoadId load_named(const StepAction& wanted);
/// nullptr: nothing.
const plant::Load* load_on(const FleetState& fleet, const plant::VehicleId& vehicle);
const plant::Load* load_at(const FleetState& fleet, const plant::StationId& station);
/// A pick or a drop has been sent, and the vehicle has not ended it.
bool is_transferring(const LiveVehicle& live);

/// Whether the vehicle may take a load over (`wanted`: pick {load}) or set it down (drop) where
/// it stands. Errors: unknown_load; no_support_here, vehicle_loaded {load},
/// load_elsewhere {load, vehicle or station}, those of plant::cannot_carry; vehicle_empty,
/// support_taken {load}, brackets_too_low {height_m, least_m}.
Status may_transfer(const FleetState& fleet, const LiveVehicle& live, const StepAction& wanted);
/// The action that the vehicle hears of it. REQUIRES: may_transfer.
vda5050::Action transfer_action(const FleetState& fleet, const LiveVehicle& live,
                                const StepAction& wanted);
/// Who has moved a load: a person, or a leg of an order.
struct MovedBy {
    std::string actor = {};
    JobOrderId order = {};
    LegId leg = {};
};
/// The vehicle has done what it was asked for: the load has another place.
void note_transferred(FleetState& fleet, LiveVehicle& live, const StepAction& done,
                      const MovedBy& by, Time now);
/// Nobody is just taking it over. Errors: load_in_transfer {load, vehicle}.
Status is_not_taken_over(const FleetState& fleet, const plant::Load& load);
/// The load is there from now on.
void move_load(FleetState& fleet, const plant::LoadId& id, const LoadPlace& to, const MovedBy& by,
               Time now);

}  // namespace pulseline::fleet
