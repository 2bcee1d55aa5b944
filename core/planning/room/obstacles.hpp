#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// How near a swept area comes to something, and to what.
struct Approach {
    double distance_m = 0;
    std::string what;  // "wall", an area's id, or "map" for a marked cell that belongs to neither
    geometry::Point2 at;  // of the obstacle
};

/// Everything that stands still in a hall: walls, areas nobody may touch, occupied grid cells.
class Obstacles {
public:
    /// One limit per obstacle.
    using Limits = std::vector<double>;

    Obstacles(const plant::Plant& plant, const plant::Hall& hall);

    Limits limits(double clearance_m) const;
    /// As limits(), but an obstacle that `standing` is already nearer to than that may stay as
    /// near: a vehicle must be able to leave the place it was measured at.
    Limits limits_from(const std::vector<geometry::Polygon>& standing, double clearance_m) const;

    /// The worst violation of the limits, or none. `pieces` are convex.
    std::optional<Approach> violation(const std::vector<geometry::Polygon>& pieces,
                                      const Limits& limits) const;
    bool keeps(const std::vector<geometry::Polygon>& pieces, const Limits& limits) const;
    /// Least distance to any obstacle.
    Approach nearest(const std::vector<geometry::Polygon>& pieces) const;

private:
    struct Shape {
        std::string name;
        geometry::Polygon outline;  // of a wall: its two ends
        geometry::Box box;
    };
    struct Hit {
        double distance_m;
        std::size_t obstacle;
        geometry::Point2 at;
    };

    void index_grid();
    std::string name_of(const Hit& hit) const;
    /// Distance to shape i, or to the grid for i = shapes; at least `stop_m` when it is farther.
    Hit approach(const geometry::Polygon& piece, const geometry::Box& box, std::size_t i,
                 double stop_m) const;
    Hit approach_grid(const geometry::Polygon& piece, const geometry::Box& box,
                      double stop_m) const;
    std::optional<Hit> worst(const std::vector<geometry::Polygon>& pieces, const Limits& limits,
                             bool any) const;

    geometry::Polygon hall_;
    std::vector<Shape> shapes_;
    plant::OccupancyGrid grid_;
    int blocks_x_ = 0;
    int blocks_y_ = 0;
    std::vector<std::vector<geometry::Point2>> blocks_;  // centres of the occupied cells at an edge
};

}  // namespace pulseline::planning
