#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

/// Whether a vehicle that may have the order could take over and set down what its steps say. What
/// is known only when it gets there is asked then (legs/step_actions.hpp). Errors, with the field:
/// missing_field, unknown_load, no_support {station}, vehicle_loaded, vehicle_empty, those of
/// plant::cannot_carry.
Status check_transfers(const FleetState& fleet, const NewOrder& order,
                       const std::vector<const plant::Station*>& stations);

}  // namespace pulseline::fleet
