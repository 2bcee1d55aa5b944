#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planning/grid_search.hpp"

// A cell is blocked for a heading when the grown body there touches an occupied cell. The body's
// shape becomes, per row of cells above or below, one run of columns that it may touch; a row is
// then tested by a difference of prefix sums.
namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;

/// Columns (relative) that the shape touches in one relative row.
struct Run {
    int row = 0;
    int first = 0;
    int last = -1;
};

/// Cell [i - 1/2, i + 1/2) x res about the body's centre, against a convex shape; closed sets.
std::vector<Run> runs_of(const Polygon& shape, double margin_m, double res) {
    const geometry::Box box = geometry::bounding_box(shape);
    const auto low = [&](double value) { return static_cast<int>(std::floor(value / res + 0.5)); };
    std::vector<Run> runs;
    for (int row = low(box.min.y_m - margin_m); row <= low(box.max.y_m + margin_m); ++row) {
        Run run{row, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()};
        for (int col = low(box.min.x_m - margin_m); col <= low(box.max.x_m + margin_m); ++col) {
            const double x = (col - 0.5) * res;
            const double y = (row - 0.5) * res;
            const Polygon cell{{x, y}, {x + res, y}, {x + res, y + res}, {x, y + res}};
            if (geometry::distance(shape, cell) > margin_m) continue;
            run.first = std::min(run.first, col);
            run.last = std::max(run.last, col);
        }
        if (run.first <= run.last) runs.push_back(run);
    }
    return runs;
}

/// Per row the number of occupied cells left of each column.
std::vector<std::int32_t> prefix_sums(const plant::OccupancyGrid& grid) {
    const std::size_t stride = static_cast<std::size_t>(grid.width) + 1;
    std::vector<std::int32_t> sums(stride * static_cast<std::size_t>(grid.height), 0);
    for (int row = 0; row < grid.height; ++row) {
        std::int32_t* sum = sums.data() + static_cast<std::size_t>(row) * stride;
        for (int col = 0; col < grid.width; ++col) {
            sum[col + 1] = sum[col] + (grid.is_occupied(col, row) ? 1 : 0);
        }
    }
    return sums;
}

void block(const plant::OccupancyGrid& grid, const std::vector<std::int32_t>& sums,
           const std::vector<Run>& runs, std::vector<std::uint8_t>& layer) {
    const std::size_t stride = static_cast<std::size_t>(grid.width) + 1;
    for (const Run& run : runs) {
        for (int row = 0; row < grid.height; ++row) {
            std::uint8_t* out = layer.data() + static_cast<std::size_t>(row) * grid.width;
            const int other = row + run.row;
            if (other < 0 || other >= grid.height) {
                std::fill(out, out + grid.width, std::uint8_t{1});
                continue;
            }
            const std::int32_t* sum = sums.data() + static_cast<std::size_t>(other) * stride;
            for (int col = 0; col < grid.width; ++col) {
                const int first = col + run.first;
                const int last = col + run.last;
                if (first < 0 || last >= grid.width || sum[last + 1] != sum[first]) out[col] = 1;
            }
        }
    }
}

/// The piece on its way from half a cell before to half a cell behind, along its heading: what lies
/// between neighbouring cell centres is covered too.
Polygon with_half_step(const Polygon& piece, double heading_rad, double res) {
    const double x = res / 2 * std::cos(heading_rad);
    const double y = res / 2 * std::sin(heading_rad);
    std::vector<Point2> points = geometry::transformed({-x, -y, heading_rad}, piece);
    const Polygon after = geometry::transformed({x, y, heading_rad}, piece);
    points.insert(points.end(), after.begin(), after.end());
    return geometry::convex_hull(std::move(points));
}

Polygon circle_around(double radius_m) {
    constexpr int kCorners = 32;
    Polygon circle;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * kPi * i / kCorners;
        const double r = radius_m / std::cos(kPi / kCorners);
        circle.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return circle;
}

}  // namespace

GridLayers point_layers(const plant::OccupancyGrid& grid) {
    GridLayers layers;
    layers.width = grid.width;
    layers.height = grid.height;
    for (auto& layer : layers.blocked) layer = grid.occupied;
    layers.no_turn.assign(grid.occupied.size(), 0);
    return layers;
}

GridLayers footprint_layers(const plant::OccupancyGrid& grid, const std::vector<Polygon>& body,
                            double clearance_m) {
    GridLayers layers = point_layers(grid);
    const auto sums = prefix_sums(grid);
    for (int d = 0; d < kDirections; ++d) {
        for (const Polygon& piece : body) {
            const Polygon shape = with_half_step(piece, d * kPi / 2, grid.resolution_m);
            block(grid, sums, runs_of(shape, clearance_m, grid.resolution_m),
                  layers.blocked[static_cast<std::size_t>(d)]);
        }
    }
    double reach = 0;
    for (const Polygon& piece : body) {
        for (const Point2& p : piece) reach = std::max(reach, norm(p));
    }
    block(grid, sums, runs_of(circle_around(reach), clearance_m, grid.resolution_m),
          layers.no_turn);
    return layers;
}

}  // namespace pulseline::planning
