#pragma once

#include <vector>

#include "core/planning/legs/road_leg.hpp"

namespace pulseline::planning {

/// Marks what kAuto takes of the feasible options (see ModeOption).
void suggest(const LegTask& task, std::vector<ModeOption>& options);

}  // namespace pulseline::planning
