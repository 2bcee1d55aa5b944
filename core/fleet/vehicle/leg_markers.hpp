#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// By which codes a vehicle finds its way on its leg (Li 2022, section 4).
namespace pulseline::fleet {

/// Whether it reads codes while it drives, by its factsheet.
bool reads_under_way(const LiveVehicle& live);

/// The chain of its leg, or why there is none (planning::leg_chain); nullopt when there is nothing
/// to say, or it reads no codes while it drives. From leg and plant alone, worked out once for each
/// horizon. REQUIRES: it has a leg.
const std::optional<Result<planning::LegChain>>& leg_markers(const FleetState& fleet,
                                                             const LiveVehicle& live);

}  // namespace pulseline::fleet
