#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Orders that come again and again by time: the fleet makes them when it is their turn.
namespace pulseline::fleet {

void restore_standing(FleetState& fleet, StoredFleet& stored);
/// After a restart the vehicles that schedules may set in motion need a person's act, too.
void require_persons_for_schedules(FleetState& fleet, Time now);
void take_standing(FleetState& fleet, Records& records);
/// Makes the orders whose time has come.
void run_schedules(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
