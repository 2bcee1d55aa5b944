#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// How long a vehicle has been silent, and what follows of it.
namespace pulseline::fleet {

void connect(FleetState& fleet, VehicleRun& run, Time now);
void disconnect(FleetState& fleet, VehicleRun& run, Time now);
void hear(FleetState& fleet, VehicleRun& run, Time now);
void update_links(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
