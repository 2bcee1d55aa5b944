#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace pulseline::plant {

/// Occupancy grid in the sense of ROS map_server. Row 0 is the SOUTH row (image files are flipped
/// on loading), cell (col, row) covers [origin + col*res, origin + (col+1)*res) x same for rows.
struct OccupancyGrid {
    int width = 0;
    int height = 0;
    double resolution_m = 0;
    geometry::Point2 origin;             // south-west corner in the hall frame
    std::vector<std::uint8_t> occupied;  // width*height, row-major, 1 = may not be touched

    bool empty() const { return occupied.empty(); }
    bool is_occupied(int col, int row) const {
        return col < 0 || row < 0 || col >= width || row >= height ||
               occupied[static_cast<std::size_t>(row) * width + col] != 0;
    }
};

}  // namespace pulseline::plant
