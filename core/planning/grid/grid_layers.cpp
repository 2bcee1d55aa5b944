#include "core/planning/grid/grid_layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;
using Run = FootprintLayers::Run;

/// Cell [i - 1/2, i + 1/2) x res about the body's centre, against a convex shape; closed sets.
void append_runs(const Polygon& shape, double margin_m, double res, std::vector<Run>& runs) {
    const geometry::Box box = geometry::bounding_box(shape);
    const auto low = [&](double value) { return static_cast<int>(std::floor(value / res + 0.5)); };
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

BitGrid occupied_bits(const plant::OccupancyGrid& grid) {
    BitGrid bits(grid.width, grid.height);
    std::size_t i = 0;
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            if (grid.occupied[i++] != 0) bits.set({col, row}, true);
        }
    }
    return bits;
}

/// Blocks every cell at which one of the runs touches an occupied cell or leaves the grid: each
/// stretch of occupied cells, widened by the run.
void block(const BitGrid& occupied, const std::vector<Run>& runs, BitGrid& layer) {
    const int width = occupied.width();
    for (const Run& run : runs) {
        for (int row = 0; row < occupied.height(); ++row) {
            const int other = row + run.row;
            if (other < 0 || other >= occupied.height()) {
                layer.set_range(row, 0, width - 1);
                continue;
            }
            layer.set_range(row, 0, -run.first - 1);
            layer.set_range(row, width - run.last, width - 1);
            for (int col = 0; col < width;) {
                if (!occupied.test({col, other})) {
                    ++col;
                    continue;
                }
                const int begin = col;
                while (col < width && occupied.test({col, other})) ++col;
                layer.set_range(row, begin - run.last, col - 1 - run.first);
            }
        }
    }
}

}  // namespace

void GridLayers::make_one_way(Cell cell, Direction way) {
    for (int d = 0; d < kDirections; ++d) {
        BitGrid& layer = no_exit[static_cast<std::size_t>(d)];
        if (layer.empty()) layer = BitGrid(width, height);
        layer.set(cell, d != static_cast<int>(way));
    }
}

std::size_t GridLayers::bytes() const {
    std::size_t sum = no_turn.bytes() + weight.size();
    for (const BitGrid& layer : blocked) sum += layer.bytes();
    for (const BitGrid& layer : no_exit) sum += layer.bytes();
    return sum;
}

GridLayers point_layers(const plant::OccupancyGrid& grid) {
    GridLayers layers;
    layers.width = grid.width;
    layers.height = grid.height;
    layers.blocked.fill(occupied_bits(grid));
    layers.no_turn = BitGrid(grid.width, grid.height);
    return layers;
}

FootprintLayers::FootprintLayers(const plant::OccupancyGrid& grid, const std::vector<Polygon>& body,
                                 double clearance_m)
    : occupied_(occupied_bits(grid)), layers_(point_layers(grid)) {
    double reach = 0;
    for (const Polygon& piece : body) {
        for (const Point2& p : piece) reach = std::max(reach, norm(p));
        for (std::size_t d = 0; d < kDirections; ++d) {
            const double heading = static_cast<double>(d) * kPi / 2;
            append_runs(with_half_step(piece, heading, grid.resolution_m), clearance_m,
                        grid.resolution_m, runs_[d]);
        }
    }
    append_runs(circle_around(reach), clearance_m, grid.resolution_m, runs_[kTurnLayer]);
    for (auto& runs : runs_) runs.push_back({0, 0, 0});  // the centre's own cell
    for (std::size_t i = 0; i <= kTurnLayer; ++i) block(occupied_, runs_[i], layer(i));
}

bool FootprintLayers::touches(const std::vector<Run>& runs, Cell at) const {
    return std::any_of(runs.begin(), runs.end(), [&](const Run& run) {
        const int row = at.row + run.row;
        const int first = at.col + run.first;
        const int last = at.col + run.last;
        return row < 0 || row >= occupied_.height() || first < 0 || last >= occupied_.width() ||
               occupied_.any(row, first, last);
    });
}

CellBox FootprintLayers::set_occupied(Cell cell, bool occupied) {
    if (occupied_.test(cell) == occupied) return {};
    occupied_.set(cell, occupied);
    CellBox changed{cell, cell};
    for (std::size_t i = 0; i <= kTurnLayer; ++i) {
        for (const Run& run : runs_[i]) {
            const int row = cell.row - run.row;
            if (row < 0 || row >= layers_.height) continue;
            const int first = std::max(cell.col - run.last, 0);
            const int last = std::min(cell.col - run.first, layers_.width - 1);
            if (first > last) continue;
            if (occupied) {
                layer(i).set_range(row, first, last);
            } else {
                for (int col = first; col <= last; ++col) {
                    layer(i).set({col, row}, touches(runs_[i], {col, row}));
                }
            }
            changed.first = {std::min(changed.first.col, first), std::min(changed.first.row, row)};
            changed.last = {std::max(changed.last.col, last), std::max(changed.last.row, row)};
        }
    }
    return changed;
}

}  // namespace pulseline::planning
