#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// What vehicles with receivers of iGPS know of the transmitters; the server owns that survey.
namespace pulseline::fleet {

/// Sends those of its hall to a vehicle that announces setTransmitters, as one does whenever it
/// connects.
void tell_transmitters(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
