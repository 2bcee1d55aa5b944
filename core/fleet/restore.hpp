#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// The fleet after a restart.
namespace pulseline::fleet {

void take_vehicles_of_plant(FleetState& fleet);
/// Fills an empty fleet from plant and store. Open orders wait for a person's act.
void restore(FleetState& fleet, StoredFleet stored, Time now);
/// What was stored by a clock that was ahead of the truth: no time lies in the future any more.
/// Before restore_standing() and restore(); event_seq is set.
void bring_back_times(FleetState& fleet, StoredFleet& stored, Time now);

}  // namespace pulseline::fleet
