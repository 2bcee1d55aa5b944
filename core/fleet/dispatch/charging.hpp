#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// When vehicles go to chargers and leave them.
namespace pulseline::fleet {

/// Vehicles without an order whose battery is low go to chargers.
void charge_low(FleetState& fleet, Time now);
/// Before a drive: whether it has to be waited for that the vehicle stops charging.
bool ends_charging(FleetState& fleet, LiveVehicle& live, Time now);
void charge_failed(FleetState& fleet, LiveVehicle& live, const std::string& why, Time now);

}  // namespace pulseline::fleet
