#pragma once

#include <vector>

#include "core/onboard/drive.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Where the body stands to look for the codes of a stop that are not in view where they should be:
/// once round the target, so near to each other that no code lies between the pictures, and within
/// `reach_m` of it; the target again at last. Li 2020, Fig. 2: it drives as was laid down before,
/// and looks again. Vehicles that cannot move sideways look ahead and behind; none where there is
/// nothing to see by.
std::vector<Pose2> search_places(const plant::VehicleType& type, const vda5050::StopTarget& target,
                                 double reach_m);

}  // namespace pulseline::onboard
