#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"

namespace pulseline::mapping {

inline constexpr int kMostCells = 25'000'000;  // 250 m x 250 m by 5 cm
inline constexpr std::uint8_t kNeverSeen = 127;
inline constexpr std::uint8_t kOccupiedBelow = 64;

/// What stands in a hall at the height of laser scanners, as they have seen it.
struct OccupancyMap {
    double cell_m = 0.05;
    geometry::Point2 corner;  // of the first cell, hall frame; columns along x, rows along y
    int columns = 0;
    int rows = 0;
    /// Row by row: 0 something stands there, 255 free, kNeverSeen.
    std::vector<std::uint8_t> free;

    std::uint8_t at(int column, int row) const {
        return free[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
    }
    bool occupied(int column, int row) const { return at(column, row) < kOccupiedBelow; }
    geometry::Point2 middle_of(int column, int row) const {
        return corner + geometry::Point2{(column + 0.5) * cell_m, (row + 0.5) * cell_m};
    }
};

/// As ROS's map server has them: FILE.yaml with the size of a cell and the corner, FILE.png with
/// the cells, first row at the bottom. Error: map_file {file, problem}.
Status write_map(const OccupancyMap& map, const std::filesystem::path& yaml);
/// Errors: map_file {file, problem}: none there, a size or a corner that cannot be, a turned map,
/// no picture, more than kMostCells.
Result<OccupancyMap> read_map(const std::filesystem::path& yaml);

}  // namespace pulseline::mapping
