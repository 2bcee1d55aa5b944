#pragma once

#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Who comes first.
namespace pulseline::fleet {

/// Open orders in a state, highest priority first, then the oldest.
std::vector<JobOrder*> by_urgency(FleetState& fleet, JobState state);

}  // namespace pulseline::fleet
