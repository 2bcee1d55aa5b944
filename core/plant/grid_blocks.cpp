#include "core/plant/grid_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::plant {
namespace {

using geometry::Point2;

/// Occupied cells side by side, over rows that have the same ones.
struct Block {
    int first_column = 0;
    int end_column = 0;  // one behind the last, as the next
    int first_row = 0;
    int end_row = 0;
};

std::vector<Block> blocks_of(const OccupancyGrid& grid) {
    std::vector<Block> done;
    std::vector<Block> open;  // that reach the row before
    for (int row = 0; row < grid.height; ++row) {
        std::vector<Block> here;
        for (int column = 0; column < grid.width; ++column) {
            if (!grid.is_occupied(column, row)) continue;
            Block run{column, column, row, row + 1};
            while (run.end_column < grid.width && grid.is_occupied(run.end_column, row)) {
                ++run.end_column;
            }
            column = run.end_column;
            here.push_back(run);
        }
        for (const Block& before : open) {
            const auto same = std::ranges::find_if(here, [&](const Block& run) {
                return run.first_column == before.first_column &&
                       run.end_column == before.end_column;
            });
            if (same == here.end()) {
                done.push_back(before);
            } else {
                same->first_row = before.first_row;
            }
        }
        open = std::move(here);
    }
    done.insert(done.end(), open.begin(), open.end());
    return done;
}

}  // namespace

std::vector<geometry::Polygon> grid_blocks(const Hall& hall) {
    const OccupancyGrid& grid = hall.grid;
    const auto corner = [&](int column, int row) {
        return grid.origin +
               grid.resolution_m * Point2{static_cast<double>(column), static_cast<double>(row)};
    };
    std::vector<geometry::Polygon> polygons;
    for (const Block& block : blocks_of(grid)) {
        const Point2 low = corner(block.first_column, block.first_row);
        const Point2 high = corner(block.end_column, block.end_row);
        if (!geometry::contains(hall.outline, 0.5 * (low + high))) continue;
        polygons.push_back({low, {high.x_m, low.y_m}, high, {low.x_m, high.y_m}});
    }
    return polygons;
}

bool crosses_grid(const Hall& hall, Point2 from, Point2 to) {
    const OccupancyGrid& grid = hall.grid;
    if (grid.empty()) return false;
    // Half a cell at a time, which may miss a corner that is cut by less.
    const double step_m = grid.resolution_m / 2;
    const int steps = static_cast<int>(distance(from, to) / step_m);
    for (int i = 1; i < steps; ++i) {
        const Point2 at = from + (static_cast<double>(i) / steps) * (to - from);
        const Point2 cell = (1 / grid.resolution_m) * (at - grid.origin);
        const int column = static_cast<int>(std::floor(cell.x_m));
        const int row = static_cast<int>(std::floor(cell.y_m));
        const bool inside = column >= 0 && row >= 0 && column < grid.width && row < grid.height;
        if (inside && grid.is_occupied(column, row)) return true;
    }
    return false;
}

}  // namespace pulseline::plant
