#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// The loads of an order: its steps' own `pick` and `drop` change what the vehicle carries from one
/// drive to the next.
namespace pulseline::fleet {

/// Its type may carry all that the order has it take over.
bool may_carry_all(const FleetState& fleet, const NewOrder& order, const LiveVehicle& live);
bool may_carry_all(const FleetState& fleet, const JobOrder& order, const LiveVehicle& live);

/// A step each: whether the vehicle drives it with a load, behind all else that a vehicle
/// that is named has to do.
/// `self`: the order itself, where it is known already.
std::vector<bool> drives_loaded(const FleetState& fleet, const NewOrder& order, JobOrderId self,
                                const LiveVehicle& live);

}  // namespace pulseline::fleet
