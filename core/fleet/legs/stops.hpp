#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// What becomes of a stop, measured or not.
namespace pulseline::fleet {

void handle_measured_stop(FleetState& fleet, LiveVehicle& live,
                          const vda5050::StopMeasurement& told, Time now);
void handle_failed_stop(FleetState& fleet, LiveVehicle& live, const std::string& why, Time now);

}  // namespace pulseline::fleet
