#pragma once

#include <optional>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Localisation from the codes that cameras see.
namespace pulseline::fleet {

std::optional<Pose2> pose_from_codes(const FleetState& fleet, const LiveVehicle& live,
                                     const std::vector<vda5050::CameraReading>& readings);

}  // namespace pulseline::fleet
