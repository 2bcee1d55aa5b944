#pragma once

#include <vector>

#include "core/planning/legs/grid_leg.hpp"
#include "core/planning/legs/road_leg.hpp"

namespace pulseline::planning {

/// Marks what kAuto takes of the feasible options (see ModeOption).
void suggest(const LegTask& task, std::vector<ModeOption>& options);

/// Gives kLinear a way over free floor and suggests it: where no mode has a plan, or what is
/// suggested follows no lanes and closed floor bars it. Who goes by lanes stays on them, closed or
/// not. With `for_people` kLinear gets it too where only another mode has a plan, for them to see.
void add_way_over_floor(const LegTask& task, GridLegs& grid, bool for_people,
                        std::vector<ModeOption>& options);

}  // namespace pulseline::planning
