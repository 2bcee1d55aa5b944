#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// What vehicles know of the beacons that they navigate by; the server owns those surveys.
namespace pulseline::fleet {

/// Sends the transmitters and reflectors of its hall to a vehicle that announces setTransmitters
/// or setReflectors, as one does whenever it connects.
void tell_beacons(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
