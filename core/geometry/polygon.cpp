#include "core/geometry/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulseline::geometry {
namespace {

constexpr double kOnEdge_m = 1e-9;  // rounding of transformed coordinates in a hall of 1 km

/// Calls visit(a, b) for every edge until it returns true; says whether it did.
template <class Visit>
bool any_edge(const Polygon& polygon, Visit visit) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        if (visit(polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1])) return true;
    }
    return false;
}

/// Squared, as all below: most distances are only compared, and a hypotenuse costs more than all
/// the rest.
double distance2_to_segment(Point2 p, Point2 a, Point2 b) {
    const Point2 ab = b - a;
    const double length2 = dot(ab, ab);
    const double s = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    const Point2 away = a + s * ab - p;
    return dot(away, away);
}

/// Whether a ray from the point to the right crosses the edge: an odd number of them from inside.
bool is_crossed(Point2 a, Point2 b, Point2 point) {
    if ((a.y_m > point.y_m) == (b.y_m > point.y_m)) return false;
    return point.x_m < a.x_m + (point.y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m);
}

bool segments_cross(Point2 a, Point2 b, Point2 c, Point2 d) {
    const double c_side = cross(b - a, c - a);
    const double d_side = cross(b - a, d - a);
    const double a_side = cross(d - c, a - c);
    const double b_side = cross(d - c, b - c);
    return ((c_side > 0) != (d_side > 0)) && ((a_side > 0) != (b_side > 0)) && c_side != 0 &&
           d_side != 0 && a_side != 0 && b_side != 0;
}

/// Distance of two segments that may touch or cross.
double segment_distance2(Point2 a, Point2 b, Point2 c, Point2 d) {
    if (segments_cross(a, b, c, d)) return 0;
    return std::min({distance2_to_segment(a, c, d), distance2_to_segment(b, c, d),
                     distance2_to_segment(c, a, b), distance2_to_segment(d, a, b)});
}

double box_distance(const Box& a, const Box& b) {
    const double dx = std::max({0.0, b.min.x_m - a.max.x_m, a.min.x_m - b.max.x_m});
    const double dy = std::max({0.0, b.min.y_m - a.max.y_m, a.min.y_m - b.max.y_m});
    return std::hypot(dx, dy);
}

double edge_distance(const Polygon& a, const Polygon& b, double stop_at) {
    double least2 = std::numeric_limits<double>::infinity();
    any_edge(a, [&](Point2 a0, Point2 a1) {
        return any_edge(b, [&](Point2 b0, Point2 b1) {
            least2 = std::min(least2, segment_distance2(a0, a1, b0, b1));
            return least2 <= stop_at * stop_at;
        });
    });
    return std::sqrt(least2);
}

}  // namespace

Polygon transformed(const Pose2& target_from_polygon, const Polygon& polygon) {
    const double c = std::cos(target_from_polygon.heading_rad);
    const double s = std::sin(target_from_polygon.heading_rad);
    Polygon result;
    result.reserve(polygon.size());
    for (const Point2& p : polygon) {
        result.push_back({target_from_polygon.x_m + c * p.x_m - s * p.y_m,
                          target_from_polygon.y_m + s * p.x_m + c * p.y_m});
    }
    return result;
}

Box bounding_box(const Polygon& polygon) {
    if (polygon.empty()) return {};
    Box box{polygon.front(), polygon.front()};
    for (const Point2& p : polygon) {
        box.min = {std::min(box.min.x_m, p.x_m), std::min(box.min.y_m, p.y_m)};
        box.max = {std::max(box.max.x_m, p.x_m), std::max(box.max.y_m, p.y_m)};
    }
    return box;
}

double area_m2(const Polygon& polygon) {
    if (polygon.size() < 3) return 0;
    double twice = 0;
    const Point2 origin = polygon.front();  // keeps the products small far from the hall's origin
    any_edge(polygon, [&](Point2 a, Point2 b) {
        twice += cross(a - origin, b - origin);
        return false;
    });
    return std::abs(twice) / 2;
}

bool contains(const Polygon& polygon, Point2 point) {
    bool inside = false;
    const bool on_edge = any_edge(polygon, [&](Point2 a, Point2 b) {
        inside ^= is_crossed(a, b, point);
        return distance2_to_segment(point, a, b) <= kOnEdge_m * kOnEdge_m;
    });
    return on_edge || inside;
}

bool crosses(const Polygon& polygon, Point2 from, Point2 to) {
    const auto side = [](Point2 a, Point2 b, Point2 p) { return cross(b - a, p - a); };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 a = polygon[i];
        const Point2 b = polygon[(i + 1) % polygon.size()];
        if (side(from, to, a) * side(from, to, b) < 0 && side(a, b, from) * side(a, b, to) < 0)
            return true;
    }
    return false;
}

bool intersects(const Polygon& a, const Polygon& b) {
    if (a.empty() || b.empty()) return false;
    if (box_distance(bounding_box(a), bounding_box(b)) > kOnEdge_m) return false;
    return contains(a, b.front()) || contains(b, a.front()) ||
           edge_distance(a, b, kOnEdge_m) <= kOnEdge_m;
}

double distance(const Polygon& a, const Polygon& b) {
    if (a.empty() || b.empty()) return std::numeric_limits<double>::infinity();
    if (contains(a, b.front()) || contains(b, a.front())) return 0;
    const double least = edge_distance(a, b, 0);
    return least <= kOnEdge_m ? 0 : least;
}

double distance(const Polygon& polygon, Point2 point) {
    bool inside = false;
    double least2 = std::numeric_limits<double>::infinity();
    any_edge(polygon, [&](Point2 a, Point2 b) {
        inside ^= is_crossed(a, b, point);
        least2 = std::min(least2, distance2_to_segment(point, a, b));
        return false;
    });
    return inside ? 0 : std::sqrt(least2);
}

double signed_area(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        twice += cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
    }
    return twice / 2;
}

Polygon convex_hull(std::vector<Point2> points) {
    std::sort(points.begin(), points.end(), [](Point2 a, Point2 b) {
        return a.x_m < b.x_m || (a.x_m == b.x_m && a.y_m < b.y_m);
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Polygon hull;  // Andrew's monotone chain
    const auto add = [&](Point2 p, std::size_t base) {
        while (hull.size() >= base + 2 &&
               cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) {
            hull.pop_back();
        }
        hull.push_back(p);
    };
    for (const Point2& p : points) add(p, 0);
    const std::size_t lower = hull.size() - 1;
    for (auto it = points.rbegin() + 1; it != points.rend(); ++it) add(*it, lower);
    hull.pop_back();
    return hull;
}

Polygon rectangle(double length_m, double width_m) {
    const double x = length_m / 2;
    const double y = width_m / 2;
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

}  // namespace pulseline::geometry
