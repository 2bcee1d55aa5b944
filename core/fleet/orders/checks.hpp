#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Whether what a request says fits the plant and the other orders; each error names the field.
namespace pulseline::fleet {

/// Vehicle, vehicle type and sequence know each other.
Status check_vehicle_fields(const FleetState& fleet, const NewOrder& order);
/// Whether the order may be given to this vehicle, by type, sequence and actions.
bool may_have(const FleetState& fleet, const NewOrder& order, const LiveVehicle& live);
/// Checks times, dependencies and actions too, and finds the orders that `after` names.
/// `self`: the order that is to be updated; empty: a new one.
Result<std::vector<Dependency>> resolve_fields(const FleetState& fleet, const NewOrder& order,
                                               JobOrderId self);

}  // namespace pulseline::fleet
