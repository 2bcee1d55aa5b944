#include "core/planning/room/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pulseline::planning {
namespace {

using geometry::Box;
using geometry::Point2;
using geometry::Polygon;

constexpr int kBlockCells = 16;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRounding_m = 1e-9;
// The hulls of a sweep stand out by up to 5 mm, and so may a start that is measured again.
constexpr double kLeaving_m = 0.010;
constexpr double kLeast_m = 0.10;  // nearer than this nothing drives by itself

double box_distance(const Box& a, const Box& b) {
    const double dx = std::max({0.0, b.min.x_m - a.max.x_m, a.min.x_m - b.max.x_m});
    const double dy = std::max({0.0, b.min.y_m - a.max.y_m, a.min.y_m - b.max.y_m});
    return std::hypot(dx, dy);
}

/// Point of b next to a (a corner of a and an edge of b, or the other way round).
Point2 nearest_point(const Polygon& a, const Polygon& b) {
    double least = kInfinite;
    Point2 at = b.front();
    const auto look = [&](const Polygon& corners, const Polygon& edges, bool on_edge) {
        for (const Point2& p : corners) {
            for (std::size_t i = 0; i < edges.size(); ++i) {
                const Point2 e0 = edges[i];
                const Point2 e = edges[(i + 1) % edges.size()] - e0;
                const double s =
                    dot(e, e) > 0 ? std::clamp(dot(p - e0, e) / dot(e, e), 0.0, 1.0) : 0;
                const Point2 q = e0 + s * e;
                if (const double d = geometry::distance(p, q); d < least) {
                    least = d;
                    at = on_edge ? q : p;
                }
            }
        }
    };
    look(a, b, true);
    look(b, a, false);
    return at;
}

Polygon square(Point2 centre, double size_m) {
    const double h = size_m / 2;
    return {{centre.x_m - h, centre.y_m - h},
            {centre.x_m + h, centre.y_m - h},
            {centre.x_m + h, centre.y_m + h},
            {centre.x_m - h, centre.y_m + h}};
}

}  // namespace

Obstacles::Obstacles(const plant::Plant& plant, const plant::Hall& hall)
    : hall_(hall.outline), grid_(hall.grid) {
    for (std::size_t i = 0; i < hall_.size(); ++i) {
        const Polygon wall{hall_[i], hall_[(i + 1) % hall_.size()]};
        shapes_.push_back({"wall", wall, geometry::bounding_box(wall)});
    }
    for (const plant::Area& area : plant.areas) {
        const bool solid =
            area.kind == plant::AreaKind::kNoGo || area.kind == plant::AreaKind::kObstacle;
        if (!solid || area.hall != hall.id || area.outline.empty()) continue;
        shapes_.push_back({area.id.str(), area.outline, geometry::bounding_box(area.outline)});
    }
    if (!grid_.empty()) index_grid();
}

void Obstacles::index_grid() {
    blocks_x_ = (grid_.width + kBlockCells - 1) / kBlockCells;
    blocks_y_ = (grid_.height + kBlockCells - 1) / kBlockCells;
    blocks_.resize(static_cast<std::size_t>(blocks_x_) * static_cast<std::size_t>(blocks_y_));
    for (int row = 0; row < grid_.height; ++row) {
        for (int col = 0; col < grid_.width; ++col) {
            if (!grid_.is_occupied(col, row)) continue;
            // A body cannot reach an inner cell without touching one at the edge first.
            if (grid_.is_occupied(col - 1, row) && grid_.is_occupied(col + 1, row) &&
                grid_.is_occupied(col, row - 1) && grid_.is_occupied(col, row + 1)) {
                continue;
            }
            const auto block =
                static_cast<std::size_t>(row / kBlockCells) * static_cast<std::size_t>(blocks_x_) +
                static_cast<std::size_t>(col / kBlockCells);
            blocks_[block].push_back({grid_.origin.x_m + (col + 0.5) * grid_.resolution_m,
                                      grid_.origin.y_m + (row + 0.5) * grid_.resolution_m});
        }
    }
}

Obstacles::Hit Obstacles::approach_grid(const Polygon& piece, const Box& box, double stop_m) const {
    const double res = grid_.resolution_m;
    Hit hit{stop_m, shapes_.size(), piece.front()};
    const auto cell = [&](double offset_m) { return static_cast<int>(std::floor(offset_m / res)); };
    const Point2 first = piece.front() - grid_.origin;
    if (grid_.is_occupied(cell(first.x_m), cell(first.y_m))) {
        hit.distance_m = 0;
        return hit;
    }
    // A piece that lies aslant fills little of its box.
    const auto is_farther = [&](Point2 middle, double size_m, double than_m) {
        return geometry::distance(piece, middle) - size_m * std::numbers::sqrt2 / 2 >= than_m;
    };
    const double block_m = res * kBlockCells;
    const double reach = std::min(stop_m, block_m * std::max(blocks_x_, blocks_y_));
    const auto block_range = [&](double min_m, double max_m, int count) {
        const auto clamped = [&](double v) {
            return static_cast<int>(std::clamp(std::floor(v / block_m), -1.0, double(count)));
        };
        return std::pair{std::max(0, clamped(min_m)), std::min(count - 1, clamped(max_m))};
    };
    const auto [x0, x1] = block_range(box.min.x_m - reach - grid_.origin.x_m,
                                      box.max.x_m + reach - grid_.origin.x_m, blocks_x_);
    const auto [y0, y1] = block_range(box.min.y_m - reach - grid_.origin.y_m,
                                      box.max.y_m + reach - grid_.origin.y_m, blocks_y_);
    for (int by = y0; by <= y1; ++by) {
        for (int bx = x0; bx <= x1; ++bx) {
            const auto& cells =
                blocks_[static_cast<std::size_t>(by) * static_cast<std::size_t>(blocks_x_) +
                        static_cast<std::size_t>(bx)];
            if (cells.empty()) continue;
            const Point2 corner{grid_.origin.x_m + bx * block_m, grid_.origin.y_m + by * block_m};
            const Point2 middle = corner + Point2{block_m / 2, block_m / 2};
            if (box_distance(box, {corner, corner + Point2{block_m, block_m}}) >= hit.distance_m ||
                is_farther(middle, block_m, hit.distance_m)) {
                continue;
            }
            for (const Point2& centre : cells) {
                const Box cell_box{centre - Point2{res / 2, res / 2},
                                   centre + Point2{res / 2, res / 2}};
                if (box_distance(box, cell_box) >= hit.distance_m ||
                    is_farther(centre, res, hit.distance_m)) {
                    continue;
                }
                const double d = geometry::distance(piece, square(centre, res));
                if (d < hit.distance_m) hit = {d, shapes_.size(), centre};
            }
        }
    }
    return hit;
}

Obstacles::Hit Obstacles::approach(const Polygon& piece, const Box& box, std::size_t i,
                                   double stop_m) const {
    if (i == shapes_.size()) return approach_grid(piece, box, stop_m);
    const Shape& shape = shapes_[i];
    if (box_distance(box, shape.box) >= stop_m) return {stop_m, i, {}};
    return {geometry::distance(piece, shape.outline), i, {}};
}

std::optional<Obstacles::Hit> Obstacles::worst(const std::vector<Polygon>& pieces,
                                               const Limits& limits, bool any) const {
    std::vector<Box> boxes;
    for (const Polygon& piece : pieces) {
        if (!piece.empty() && !geometry::contains(hall_, piece.front())) {
            return Hit{0, 0, piece.front()};
        }
        boxes.push_back(geometry::bounding_box(piece));
    }
    std::optional<Hit> found;
    const std::size_t count = shapes_.size() + (grid_.empty() ? 0 : 1);
    for (std::size_t i = 0; i < count; ++i) {  // the grid last: what is found bounds its search
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            if (pieces[k].empty()) continue;
            const double stop = found ? std::min(limits[i], found->distance_m) : limits[i];
            Hit hit = approach(pieces[k], boxes[k], i, stop);
            if (hit.distance_m >= stop - (found ? 0 : kRounding_m)) continue;
            if (i < shapes_.size() && !any) hit.at = nearest_point(pieces[k], shapes_[i].outline);
            found = hit;
            if (any) return found;
        }
    }
    return found;
}

std::string Obstacles::name_of(const Hit& hit) const {
    if (hit.obstacle < shapes_.size()) return shapes_[hit.obstacle].name;
    const double near = 2 * grid_.resolution_m;  // the drawn cell of a wall or area
    for (const Shape& shape : shapes_) {
        if (geometry::distance(square(hit.at, grid_.resolution_m), shape.outline) <= near) {
            return shape.name;
        }
    }
    return "map";
}

Obstacles::Limits Obstacles::limits(double clearance_m) const {
    return Limits(shapes_.size() + 1, clearance_m);
}

Obstacles::Limits Obstacles::limits_from(const std::vector<Polygon>& standing,
                                         double clearance_m) const {
    Limits result = limits(clearance_m);
    const std::size_t count = shapes_.size() + (grid_.empty() ? 0 : 1);
    for (const Polygon& piece : standing) {
        const Box box = geometry::bounding_box(piece);
        for (std::size_t i = 0; i < count; ++i) {
            const double d = approach(piece, box, i, clearance_m).distance_m;
            if (d < clearance_m)
                result[i] = std::min(result[i], std::max(kLeast_m, d - kLeaving_m));
        }
    }
    return result;
}

std::optional<Approach> Obstacles::violation(const std::vector<Polygon>& pieces,
                                             const Limits& limits) const {
    const auto hit = worst(pieces, limits, false);
    if (!hit) return std::nullopt;
    return Approach{hit->distance_m, name_of(*hit), hit->at};
}

bool Obstacles::keeps(const std::vector<Polygon>& pieces, const Limits& limits) const {
    return !worst(pieces, limits, true);
}

Approach Obstacles::nearest(const std::vector<Polygon>& pieces) const {
    const auto hit = worst(pieces, limits(kInfinite), false);
    return hit ? Approach{hit->distance_m, name_of(*hit), hit->at} : Approach{kInfinite, "", {}};
}

}  // namespace pulseline::planning
