#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// Distance from any place of a hall to what stands still there: walls, no-go areas, obstacles and
/// marked cells of its map, as `Obstacles` knows them, the map's border, and whatever is added.
/// Exact distances at the nodes of a lattice, bilinear in between; 0 inside obstacles, outside the
/// hall and outside its map.
///
/// Cost: a hall of 120 m x 60 m takes some 10 ms and 3 MB at most, once. A copy shares its tiles
/// and takes microseconds, so that what stands for one query only is added to a copy.
/// Thread safety: an unchanging field, and copies of it, may be read by any number of threads.
class FloorField {
public:
    /// Distances are told up to `reach_m`; what is farther counts as that far.
    FloorField(const plant::Plant& plant, const plant::Hall& hall, double reach_m);

    /// Adds bodies: simple polygons, hall frame.
    void add(const std::vector<geometry::Polygon>& outlines);

    /// At most reach_m(); differs from the truth by no more than needed_m() tells.
    double distance_m(geometry::Point2 at) const {
        const double fx = (at.x_m - origin_.x_m) * per_m_;
        const double fy = (at.y_m - origin_.y_m) * per_m_;
        if (!(fx >= 0 && fy >= 0 && fx < limit_x_ && fy < limit_y_)) return 0;
        const int x = static_cast<int>(fx);
        const int y = static_cast<int>(fy);
        const float* node =
            tiles_[static_cast<std::size_t>((y / kTile) * tiles_x_ + x / kTile)]->data() +
            (y % kTile) * kSide + x % kTile;
        const double sx = fx - x;
        const double sy = fy - y;
        const double low = node[0] + sx * (node[1] - node[0]);
        const double high = node[kSide] + sx * (node[kSide + 1] - node[kSide]);
        return low + sy * (high - low);
    }
    /// What distance_m must give at least to prove that the true distance is at least `true_m`.
    /// With node spacing h and true distance d, the nodes about a place average to at most
    /// d + h^2 / (4 d) (Taylor bound of |v + e| over a bilinear cell) and d + h / sqrt(2).
    double needed_m(double true_m) const;

    double reach_m() const { return reach_m_; }
    geometry::Box box() const { return box_; }  // of the hall
    double spacing_m() const { return spacing_m_; }

private:
    static constexpr int kTile = 32;         // cells along a tile's side
    static constexpr int kSide = kTile + 1;  // its nodes; the last ones are also the next tile's
    using Tile = std::array<float, kSide * kSide>;

    geometry::Point2 node_at(int tile_x, int tile_y, int x, int y) const;
    template <class DistanceTo>
    void lower(const geometry::Box& box, const DistanceTo& distance_to);
    void add_grid(const plant::OccupancyGrid& grid);

    double reach_m_;
    geometry::Box box_;
    double spacing_m_ = 0;
    double per_m_ = 0;
    geometry::Point2 origin_;
    int tiles_x_ = 0;
    int tiles_y_ = 0;
    double limit_x_ = 0;
    double limit_y_ = 0;
    std::vector<std::shared_ptr<const Tile>> tiles_;
};

}  // namespace pulseline::planning
