#pragma once

#include <string>
#include <vector>

#include "server/agent/vehicle.hpp"

namespace pulseline::agent {

/// What a hand-held control asked of one of the vehicles in one line, done and answered; the lines
/// are described at HandHeldLink.
std::string answer_hand_held(const std::vector<Vehicle*>& vehicles, const std::string& line,
                             Vehicle::Steady::time_point now = Vehicle::Steady::now());

}  // namespace pulseline::agent
