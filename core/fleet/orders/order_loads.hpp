#pragma once

#include <optional>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// The loads of an order: its steps' own `pick` and `drop` change what the vehicle carries from one
/// drive to the next.
namespace pulseline::fleet {

/// Why its type may not carry all that the order has it take over yet: unknown_load {load}, or the
/// first one's of plant::cannot_carry; nothing: it may. What lies behind it may be gone meanwhile.
std::optional<Reason> cannot_carry_all(const FleetState& fleet, const NewOrder& order,
                                       const LiveVehicle& live);
std::optional<Reason> cannot_carry_all(const FleetState& fleet, const JobOrder& order,
                                       const LiveVehicle& live);
/// The open order that will take the load over; nullptr: none will.
const JobOrder* order_of_load(const FleetState& fleet, const plant::LoadId& load);

/// A step each: whether the vehicle drives it with a load, behind all else that a vehicle
/// that is named has to do.
/// `self`: the order itself, where it is known already.
std::vector<bool> drives_loaded(const FleetState& fleet, const NewOrder& order, JobOrderId self,
                                const LiveVehicle& live);

}  // namespace pulseline::fleet
