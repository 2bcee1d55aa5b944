#pragma once

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

/// The vehicle shows another order than its leg, or none: the leg is still on its way to it, was
/// refused by it, or is lost.
void handle_other_order(FleetState& fleet, LiveVehicle& live, Time now);

/// Restarted, switched to manual or cancelled by hand: it does not carry out its order any more.
void lose_order(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
