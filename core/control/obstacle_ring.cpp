#include "core/control/obstacle_ring.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace pulseline::control {
namespace {

using geometry::Point2;

constexpr double kLeastStretch_m = 0.04;
constexpr double kStretches = 64;  // around the outline, about
constexpr double kFan_rad = radians(6.0);
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

Point2 outward(Point2 along) { return {along.y_m, -along.x_m}; }

}  // namespace

ObstacleRing::ObstacleRing(const geometry::Polygon& outline) {
    const geometry::Polygon hull = geometry::convex_hull(outline);
    assert(hull.size() >= 3);
    box_ = geometry::bounding_box(hull);
    double around_m = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point2 way = hull[(i + 1) % hull.size()] - hull[i];
        const double length = norm(way);
        edges_.push_back({hull[i], (1 / length) * way, length});
        around_m += length;
    }
    stretch_m_ = std::max(kLeastStretch_m, around_m / kStretches);
    std::size_t count = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        edges_[i].first_stretch = count;
        count += 1 + static_cast<std::size_t>(edges_[i].length_m / stretch_m_);
        const Edge& before = edges_[(i + edges_.size() - 1) % edges_.size()];
        const double bend_rad =
            std::acos(std::clamp(dot(before.along, edges_[i].along), -1.0, 1.0));
        edges_[i].first_fan = count;
        count += 1 + static_cast<std::size_t>(bend_rad / kFan_rad);
    }
    place_of_.assign(count, kNone);
    places_.reserve(count);
}

std::size_t ObstacleRing::fan_of(std::size_t corner, Point2 away) const {
    const Edge& before = edges_[(corner + edges_.size() - 1) % edges_.size()];
    const Point2 first = outward(before.along);
    const double angle = std::max(0.0, std::atan2(cross(first, away), dot(first, away)));
    const std::size_t end =
        corner + 1 < edges_.size() ? edges_[corner + 1].first_stretch : place_of_.size();
    return std::min(edges_[corner].first_fan + static_cast<std::size_t>(angle / kFan_rad), end - 1);
}

void ObstacleRing::clear(double reach_m) {
    reach_m_ = reach_m;
    places_.clear();
    std::ranges::fill(place_of_, kNone);
}

void ObstacleRing::add(Point2 p) {
    // So that neither infinite points nor such that are no numbers pass.
    const bool near = p.x_m >= box_.min.x_m - reach_m_ && p.x_m <= box_.max.x_m + reach_m_ &&
                      p.y_m >= box_.min.y_m - reach_m_ && p.y_m <= box_.max.y_m + reach_m_;
    if (!near) return;
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
    const std::size_t i =
        nearest != nullptr ? static_cast<std::size_t>(nearest - edges_.data()) : 0;
    const Edge& edge = edges_[i];
    const Point2 foot = edge.from + nearest_along * edge.along;
    place.distance_m = inside ? 0 : std::sqrt(least2);
    place.away =
        place.distance_m > 1e-9 ? (1 / place.distance_m) * (p - foot) : outward(edge.along);
    place.lever_m = cross(foot, place.away);

    const bool at_start = nearest_along == 0;
    std::size_t bin = edge.first_stretch + static_cast<std::size_t>(nearest_along / stretch_m_);
    if (at_start || nearest_along == edge.length_m) {
        bin = fan_of(at_start ? i : (i + 1) % edges_.size(), place.away);
        place.away_blur = std::sin(kFan_rad);
        place.lever_blur_m = place.away_blur * norm(foot);
    } else {
        place.lever_blur_m = stretch_m_;
    }
    std::size_t& index = place_of_[bin];
    if (index == kNone) {
        index = places_.size();
        places_.push_back(place);
    } else if (place.distance_m < places_[index].distance_m) {
        places_[index] = place;
    }
}

double ObstacleRing::distance_after(const Place& place, const Pose2& motion) {
    const double way_m = norm(motion.position());
    const double turn_rad = std::abs(motion.heading_rad);
    const double nearer_m = dot(place.away, motion.position()) + place.away_blur * way_m;
    const double turned_m = place.lever_m * motion.heading_rad + place.lever_blur_m * turn_rad;
    // What the first order leaves out of a turn by that much after a way of that much.
    const double slack_m = turn_rad * (place.reach_m * turn_rad / 2 + way_m);
    return place.distance_m - std::max(0.0, nearer_m) - std::max(0.0, turned_m) - slack_m;
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
