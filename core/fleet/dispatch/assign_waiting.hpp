#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Which free vehicle gets which waiting order.
namespace pulseline::fleet {

/// Free vehicles get waiting orders: one assignment of least cost .
void assign_waiting(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
