#include "core/control/obstacle_ring.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace pulseline::control {
namespace {

using geometry::Point2;

constexpr double kStretch_m = 0.04;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

}  // namespace

ObstacleRing::ObstacleRing(const geometry::Polygon& outline) {
    const geometry::Polygon hull = geometry::convex_hull(outline);
    assert(hull.size() >= 3);
    box_ = geometry::bounding_box(hull);
    std::size_t stretches = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point2 way = hull[(i + 1) % hull.size()] - hull[i];
        const double length = norm(way);
        edges_.push_back({hull[i], (1 / length) * way, length, stretches});
        // A stretch of its own for each corner, where the direction away turns quickest.
        stretches += 2 + static_cast<std::size_t>(std::ceil(length / kStretch_m));
    }
    place_of_stretch_.assign(stretches, kNone);
    places_.reserve(stretches);
}

void ObstacleRing::clear(double reach_m) {
    reach_m_ = reach_m;
    places_.clear();
    std::ranges::fill(place_of_stretch_, kNone);
}

void ObstacleRing::add(Point2 p) {
    if (p.x_m < box_.min.x_m - reach_m_ || p.x_m > box_.max.x_m + reach_m_ ||
        p.y_m < box_.min.y_m - reach_m_ || p.y_m > box_.max.y_m + reach_m_) {
        return;
    }
    double least2 = reach_m_ * reach_m_;
    const Edge* nearest = nullptr;
    double nearest_along = 0;
    bool inside = true;
    for (const Edge& edge : edges_) {
        const Point2 to = p - edge.from;
        const double along = std::clamp(dot(to, edge.along), 0.0, edge.length_m);
        const Point2 gap = to - along * edge.along;
        inside &= cross(edge.along, to) > 0;
        const double gap2 = dot(gap, gap);
        if (gap2 > least2) continue;
        least2 = gap2;
        nearest = &edge;
        nearest_along = along;
    }
    if (nearest == nullptr && !inside) return;

    Place place;
    place.obstacle = p;
    place.reach_m = norm(p);
    const Edge& edge = nearest != nullptr ? *nearest : edges_.front();
    const Point2 foot = edge.from + nearest_along * edge.along;
    place.distance_m = inside ? 0 : std::sqrt(least2);
    const Point2 outward{edge.along.y_m, -edge.along.x_m};
    place.away = place.distance_m > 1e-9 ? (1 / place.distance_m) * (p - foot) : outward;
    place.lever_m = cross(foot, place.away);

    const bool at_start = nearest_along == 0;
    const bool at_end = nearest_along == edge.length_m;
    const std::size_t stretch =
        edge.first_stretch + (at_start ? 0
                              : at_end ? 1
                                       : 2 + static_cast<std::size_t>(nearest_along / kStretch_m));
    std::size_t& index = place_of_stretch_[stretch];
    if (index == kNone) {
        index = places_.size();
        places_.push_back(place);
    } else if (place.distance_m < places_[index].distance_m) {
        places_[index] = place;
    }
}

double ObstacleRing::distance_after(const Place& place, const Pose2& motion) {
    const double nearer_m = std::max(0.0, dot(place.away, motion.position()));
    const double turned_m = std::max(0.0, place.lever_m * motion.heading_rad);
    // What the first order leaves out of a turn by that much after a way of that much.
    const double turn_rad = std::abs(motion.heading_rad);
    const double slack_m = turn_rad * (place.reach_m * turn_rad / 2 + norm(motion.position()));
    return place.distance_m - nearer_m - turned_m - slack_m;
}

double ObstacleRing::outline_distance_m(Point2 p) const {
    double least2 = std::numeric_limits<double>::infinity();
    bool inside = true;
    for (const Edge& edge : edges_) {
        const Point2 to = p - edge.from;
        const Point2 gap = to - std::clamp(dot(to, edge.along), 0.0, edge.length_m) * edge.along;
        inside &= cross(edge.along, to) > 0;
        least2 = std::min(least2, dot(gap, gap));
    }
    return inside ? 0 : std::sqrt(least2);
}

}  // namespace pulseline::control
