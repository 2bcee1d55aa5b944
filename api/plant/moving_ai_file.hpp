#pragma once

#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/planning/grid/grid.hpp"
#include "core/plant/occupancy_grid.hpp"

/// Benchmark grids and problems in the MovingAI formats (movingai.com/benchmarks/formats.html):
/// column 0 and row 0 are at the top left; free cells are '.', 'G' and 'S'.
namespace pulseline::api::plant_file {

struct MovingAiProblem {
    planning::Cell start;
    planning::Cell goal;
    double length = 0;  // shortest 8-connected way without turn costs, as the file states it
};

/// Errors: map_invalid {line}.
Result<plant::OccupancyGrid> parse_moving_ai_map(std::string_view text);
/// Errors: scenario_invalid {line}.
Result<std::vector<MovingAiProblem>> parse_moving_ai_scenario(std::string_view text);

}  // namespace pulseline::api::plant_file
