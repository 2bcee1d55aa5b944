#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace pulseline::control {

/// The obstacle points around a vehicle's outline, thinned to the nearest one for each stretch of
/// an edge and each small fan of directions at a corner, and a bound of how near small motions
/// bring them. The distance of a point from a convex body is a convex function of a shift, so its
/// tangent never promises more room than there is; slack is added for what a turn does in second
/// order and for the points left out. No allocation after construction.
class ObstacleRing {
public:
    using Point2 = geometry::Point2;
    using Pose2 = geometry::Pose2;

    struct Place {
        Point2 obstacle;     // body frame
        Point2 away;         // unit vector from the outline to it
        double lever_m = 0;  // of a turn, positive where turning left comes nearer
        double distance_m = 0;
        double reach_m = 0;  // of the obstacle from the body's origin
        // How much away and lever of the points left out may differ from these.
        double away_blur = 0;
        double lever_blur_m = 0;
    };

    /// `outline`: body frame; its convex hull counts.
    explicit ObstacleRing(const geometry::Polygon& outline);

    /// Forgets the obstacles; farther ones than `reach_m` from the outline are not kept.
    void clear(double reach_m);
    void add(Point2 obstacle);

    const std::vector<Place>& places() const { return places_; }
    /// Least distance of a place from the body on the way of a small motion, at least.
    static double distance_after(const Place& place, const Pose2& motion);

    double outline_distance_m(Point2 point) const;

private:
    struct Edge {
        Point2 from;
        Point2 along;  // unit
        double length_m = 0;
        std::size_t first_stretch = 0;
        std::size_t first_fan = 0;  // of the corner where it begins
    };

    std::size_t fan_of(std::size_t corner, Point2 away) const;

    std::vector<Edge> edges_;
    geometry::Box box_;
    double stretch_m_ = 0;
    double reach_m_ = 0;
    std::vector<Place> places_;
    std::vector<std::size_t> place_of_;  // stretch or fan
};

}  // namespace pulseline::control
