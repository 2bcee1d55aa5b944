#include "core/planning/room/floor_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pulseline::planning {
namespace {

using geometry::Box;
using geometry::Point2;
using geometry::Polygon;

constexpr double kSpacing_m = 0.1;  // 5 mm off at half a metre
constexpr double kMostNodes = 4e6;  // a hall of 400 m x 100 m; larger ones get a coarser lattice
constexpr int kBorder = 2;          // cells of the lattice outside the hall

double to_box(Point2 p, const Box& box) {
    const double dx = std::max({0.0, box.min.x_m - p.x_m, p.x_m - box.max.x_m});
    const double dy = std::max({0.0, box.min.y_m - p.y_m, p.y_m - box.max.y_m});
    return std::sqrt(dx * dx + dy * dy);
}

/// Distances to the edges of a simple polygon, edges prepared.
class Ring {
public:
    explicit Ring(const Polygon& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Point2 along = ring[(i + 1) % ring.size()] - ring[i];
            const double length2 = dot(along, along);
            if (length2 > 0) edges_.push_back({ring[i], along, 1 / length2});
        }
    }

    struct Distance {
        double m = 0;
        bool inside = false;
    };
    Distance from(Point2 p) const {
        double least2 = std::numeric_limits<double>::infinity();
        bool inside = false;
        for (const Edge& edge : edges_) {
            const Point2 off = p - edge.from;
            const double s = std::clamp(dot(off, edge.along) * edge.per_length2, 0.0, 1.0);
            const Point2 gap = off - s * edge.along;
            least2 = std::min(least2, dot(gap, gap));
            const bool above = off.y_m < 0;
            if (above == (off.y_m < edge.along.y_m)) continue;
            // The edge crosses the point's height; on its right when the cross product says so.
            if ((cross(edge.along, off) > 0) == (edge.along.y_m > 0)) inside = !inside;
        }
        return {std::sqrt(least2), inside};
    }

private:
    struct Edge {
        Point2 from;
        Point2 along;
        double per_length2;
    };
    std::vector<Edge> edges_;
};

}  // namespace

FloorField::FloorField(const plant::Plant& plant, const plant::Hall& hall, double reach_m)
    : reach_m_(reach_m), box_(geometry::bounding_box(hall.outline)) {
    const double width = box_.max.x_m - box_.min.x_m;
    const double height = box_.max.y_m - box_.min.y_m;
    spacing_m_ = std::max(kSpacing_m, std::sqrt(width * height / kMostNodes));
    per_m_ = 1 / spacing_m_;
    origin_ = box_.min - Point2{kBorder * spacing_m_, kBorder * spacing_m_};
    const auto tiles = [&](double size_m) {
        return static_cast<int>(std::ceil((size_m * per_m_ + 2 * kBorder) / kTile));
    };
    tiles_x_ = tiles(width);
    tiles_y_ = tiles(height);
    limit_x_ = tiles_x_ * kTile;
    limit_y_ = tiles_y_ * kTile;
    const auto far = std::make_shared<Tile>();
    far->fill(static_cast<float>(reach_m));
    tiles_.assign(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_), far);

    const Ring walls(hall.outline);
    lower({origin_, node_at(tiles_x_, tiles_y_, 0, 0)}, [&](Point2 p) {
        const auto distance = walls.from(p);
        return distance.inside ? distance.m : 0;
    });
    std::vector<Polygon> solid;
    for (const plant::Area& area : plant.areas) {
        const bool touchable =
            area.kind != plant::AreaKind::kNoGo && area.kind != plant::AreaKind::kObstacle;
        if (!touchable && area.hall == hall.id) solid.push_back(area.outline);
    }
    add(solid);
    if (!hall.grid.empty()) add_grid(hall.grid);
}

double FloorField::needed_m(double true_m) const {
    const double h = spacing_m_;
    const double coarse = h * (0.5 + std::numbers::sqrt2 / 2);
    if (true_m < h / 2) return coarse;
    return std::max(coarse, true_m + h * h / (4 * true_m));
}

Point2 FloorField::node_at(int tile_x, int tile_y, int x, int y) const {
    return origin_ + spacing_m_ * Point2{static_cast<double>(tile_x * kTile + x),
                                         static_cast<double>(tile_y * kTile + y)};
}

/// Lowers every node within reach of the box to its distance.
template <class DistanceTo>
void FloorField::lower(const Box& box, const DistanceTo& distance_to) {
    const auto node = [&](double offset_m) { return offset_m * per_m_; };
    const int x0 =
        static_cast<int>(std::max(0.0, std::floor(node(box.min.x_m - reach_m_ - origin_.x_m))));
    const int y0 =
        static_cast<int>(std::max(0.0, std::floor(node(box.min.y_m - reach_m_ - origin_.y_m))));
    const int x1 =
        static_cast<int>(std::min(limit_x_, std::ceil(node(box.max.x_m + reach_m_ - origin_.x_m))));
    const int y1 =
        static_cast<int>(std::min(limit_y_, std::ceil(node(box.max.y_m + reach_m_ - origin_.y_m))));
    const double half_diagonal_m = spacing_m_ * kTile * std::numbers::sqrt2 / 2;
    for (int ty = y0 / kTile; ty < tiles_y_ && ty * kTile <= y1; ++ty) {
        for (int tx = x0 / kTile; tx < tiles_x_ && tx * kTile <= x1; ++tx) {
            if (distance_to(node_at(tx, ty, kTile / 2, kTile / 2)) > reach_m_ + half_diagonal_m) {
                continue;
            }
            auto& shared = tiles_[static_cast<std::size_t>(ty * tiles_x_ + tx)];
            auto tile = std::make_shared<Tile>(*shared);
            bool changed = false;
            const int from_x = std::max(0, x0 - tx * kTile);
            const int to_x = std::min(kSide - 1, x1 - tx * kTile);
            const int from_y = std::max(0, y0 - ty * kTile);
            const int to_y = std::min(kSide - 1, y1 - ty * kTile);
            for (int y = from_y; y <= to_y; ++y) {
                float* row = tile->data() + y * kSide;
                for (int x = from_x; x <= to_x; ++x) {
                    if (row[x] == 0) continue;
                    const auto d = static_cast<float>(distance_to(node_at(tx, ty, x, y)));
                    if (d >= row[x]) continue;
                    row[x] = d;
                    changed = true;
                }
            }
            if (changed) shared = std::move(tile);
        }
    }
}

void FloorField::add(const std::vector<Polygon>& outlines) {
    for (const Polygon& outline : outlines) {
        if (outline.empty()) continue;
        const Ring ring(outline);
        lower(geometry::bounding_box(outline), [&](Point2 p) {
            const auto distance = ring.from(p);
            return distance.inside ? 0 : distance.m;
        });
    }
}

void FloorField::add_grid(const plant::OccupancyGrid& grid) {
    const double res = grid.resolution_m;
    const auto corner = [&](int col, int row) {
        return grid.origin + Point2{col * res, row * res};
    };
    for (int row = 0; row < grid.height; ++row) {
        for (int col = 0; col < grid.width; ++col) {
            if (!grid.is_occupied(col, row)) continue;
            const int first = col;
            while (col + 1 < grid.width && grid.is_occupied(col + 1, row)) ++col;
            const Box run{corner(first, row), corner(col + 1, row + 1)};
            lower(run, [&](Point2 p) { return to_box(p, run); });
        }
    }
    // Off the map nobody may drive, so its border is kept away from as a wall is.
    const Box known{corner(0, 0), corner(grid.width, grid.height)};
    lower({origin_, node_at(tiles_x_, tiles_y_, 0, 0)}, [&](Point2 p) {
        return std::max(0.0, std::min({p.x_m - known.min.x_m, known.max.x_m - p.x_m,
                                       p.y_m - known.min.y_m, known.max.y_m - p.y_m}));
    });
}

}  // namespace pulseline::planning
