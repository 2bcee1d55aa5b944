#pragma once

#include "core/base/result.hpp"
#include "core/fleet/state/fleet_state.hpp"

/// A vehicle that takes a load over or sets it down needs other floor from then on, and drives by
/// another graph.
namespace pulseline::fleet {

/// It holds floor with `load` from now on; nullptr: with none. REQUIRES: it has no leg. Errors:
/// floor_held {vehicle, other}, and nothing is changed.
Status hold_floor_with(FleetState& fleet, LiveVehicle& live, const plant::Load* load, Time now);
/// Once nothing is being taken over: with what it carries.
void settle_load(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
