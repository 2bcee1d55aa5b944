#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// When a running order will have ended.
namespace pulseline::fleet {

/// From what is left of the leg and of the steps behind it.
void expect_end(FleetState& fleet, const LiveVehicle& live, JobOrder& order, Time now);
/// Those whose time has come without their end.
void renew_expected_ends(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
