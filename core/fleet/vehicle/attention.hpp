#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// When a vehicle stops until a person has looked.
namespace pulseline::fleet {

/// The vehicle stops taking new floor until a person allows it; its order is interrupted.
void require_person(FleetState& fleet, LiveVehicle& live, Reason reason, Time now);
/// Counts an error of the vehicle. False: it has told of so many in this minute that no more become
/// events.
bool may_tell_error(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
