#pragma once

#include <optional>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// What has to be true before a start, one line a condition, as people are shown it.
namespace pulseline::fleet {

std::vector<Check> start_checks(const FleetState& fleet, const LiveVehicle& live,
                                const plant::Station* target,
                                const std::optional<planning::LegPlan>& plan, Time now);

}  // namespace pulseline::fleet
