#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

/// Direction-penalised A* on an occupancy grid, 4-connected; state = (cell, direction), exact.
namespace pulseline::planning {

enum class Direction { kEast, kNorth, kWest, kSouth };
constexpr int kDirections = 4;

struct Cell {
    int col = 0;
    int row = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
};

/// Where one vehicle may be: by heading when it drives, and where it may turn on the spot.
struct GridLayers {
    int width = 0;
    int height = 0;
    std::array<std::vector<std::uint8_t>, kDirections> blocked;  // 1: not there with that heading
    std::vector<std::uint8_t> no_turn;

    bool inside(Cell cell) const {
        return cell.col >= 0 && cell.row >= 0 && cell.col < width && cell.row < height;
    }
    std::size_t index(Cell cell) const {
        return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(cell.col);
    }
};

/// A vehicle of one cell that turns anywhere.
GridLayers point_layers(const plant::OccupancyGrid& grid);
/// A vehicle with a body (convex pieces, body frame) that keeps `clearance_m` from occupied cells;
/// its centre stands in cell centres. Conservative by less than a cell.
GridLayers footprint_layers(const plant::OccupancyGrid& grid,
                            const std::vector<geometry::Polygon>& body, double clearance_m);

/// Costs as integers of a thousandth, so that sums are exact.
struct GridCost {
    std::int64_t step = 10'000;  // straight into the next cell
    std::int64_t turn = 10'000;  // on top, after a change of direction; step + turn >= 0
};
constexpr double kCostUnit = 1000;
/// Cells of length 1 and k_diff for a cell entered after a change of direction.
Result<GridCost> unit_cell_cost(double k_same, double k_diff);
/// Cells of a hall's grid: k_same x length + the fixed charge of a plant's routing cost.
Result<GridCost> hall_cost(const plant::RoutingCost& cost, double resolution_m);

struct GridRequest {
    Cell start;
    Cell goal;
    std::optional<Direction> start_heading;  // none: free
    GridCost cost;
};

struct GridRoute {
    double cost = 0;  // in the units of k
    int length = 0;   // steps
    int turns = 0;
    std::int64_t expanded = 0;
    std::vector<Cell> cells;  // start to goal
};

/// Errors: outside_grid (kInvalid, field /start or /goal), no_route {blocked_by: start | goal |
/// obstacles}.
Result<GridRoute> plan_grid(const GridLayers& layers, const GridRequest& request);

}  // namespace pulseline::planning
