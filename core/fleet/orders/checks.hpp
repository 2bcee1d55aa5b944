#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Whether what a request says fits the plant and the other orders; each error names the field.
namespace pulseline::fleet {

/// Vehicle, vehicle type and sequence know each other.
Status check_vehicle_fields(const FleetState& fleet, const NewOrder& order);
/// What the numbers of the steps mean, one a step.
using Stations = std::vector<const plant::Station*>;
Result<Stations> stations_of(const FleetState& fleet, const NewOrder& order);

/// All that an order names, found: from here on nobody looks it up again.
struct CheckedOrder {
    Stations stations;
    std::vector<Dependency> after;
};
/// Checks every field. `self`: the order that is to be updated; empty: a new one.
Result<CheckedOrder> check_order(const FleetState& fleet, const NewOrder& order, JobOrderId self);

}  // namespace pulseline::fleet
