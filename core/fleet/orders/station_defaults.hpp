#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// What is done at a station where an order does not say it: at one that parks (plant::Station),
/// vehicles with feet are lowered onto them on arrival and raised before they leave.
namespace pulseline::fleet {

/// The order with what its stations are for, as far as all vehicles that may have it can do that.
NewOrder with_station_defaults(const FleetState& fleet, NewOrder order);

/// An order that says nothing of it finds its vehicle on its feet at a station that parks.
bool finds_parked(const FleetState& fleet, const JobOrder& order, const LiveVehicle& live);
/// Where it does, they are raised first.
void raise_parked(FleetState& fleet, JobOrder& order, const LiveVehicle& live);

}  // namespace pulseline::fleet
