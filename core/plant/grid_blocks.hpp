#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::plant {

/// What an occupancy grid has standing inside the outline of its hall, such as columns: rectangles
/// in the hall frame that cover its occupied cells once. Cells outside are the wall, which the
/// outline is.
std::vector<geometry::Polygon> grid_blocks(const Hall& hall);

/// Whether the way between two points of a hall, its ends left out, leads through such a cell.
bool crosses_grid(const Hall& hall, geometry::Point2 from, geometry::Point2 to);

}  // namespace pulseline::plant
