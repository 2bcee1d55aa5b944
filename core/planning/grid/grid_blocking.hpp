#pragma once

#include <optional>
#include <vector>

#include "core/planning/grid/grid_search.hpp"

namespace pulseline::planning {

/// A cell where a vehicle finds no room, and for what.
struct BlockingCell {
    Cell cell;
    Direction heading = Direction::kEast;  // in which it would be driven
    bool turning = false;                  // there is room for the heading, but not to turn to it
};

/// A smallest set of cells to make room in so that a route exists, in driving order: for every
/// heading and for turning, as clearing an obstacle does. One-way cells stay as they are. Empty
/// when a route exists, nullopt when even an empty floor has none. Search over (cell, direction) by
/// the number of such cells.
std::optional<std::vector<BlockingCell>> blocking_cells(const GridMap& map,
                                                        const GridRequest& request);

}  // namespace pulseline::planning
