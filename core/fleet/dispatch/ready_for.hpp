#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {

/// As not_ready, for the next step of an order: feet that are down do not bar what raises them, nor
/// a load that is not as it should be what takes it over or sets it down.
std::optional<Barred> not_ready_for(const FleetState& fleet, const JobOrder& order,
                                    const LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
