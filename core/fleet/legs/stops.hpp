#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// What becomes of a stop, measured or not.
namespace pulseline::fleet {

void take_measured_stop(FleetState& fleet, VehicleRun& run, const vda5050::StopMeasurement& told,
                        Time now);
void take_failed_stop(FleetState& fleet, VehicleRun& run, const std::string& why, Time now);

}  // namespace pulseline::fleet
