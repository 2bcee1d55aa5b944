#pragma once

#include <string>

#include "core/plant/occupancy_grid.hpp"

namespace pulseline::api {

/// 8-bit grey PNG, north up, black = occupied. Empty for an empty grid.
std::string grid_png(const plant::OccupancyGrid& grid);

}  // namespace pulseline::api
