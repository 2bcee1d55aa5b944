#pragma once

#include <cmath>
#include <vector>

#include "core/base/angle.hpp"

namespace pulseline::geometry {

struct Point2 {
    double x_m = 0;
    double y_m = 0;
    friend bool operator==(const Point2&, const Point2&) = default;
};
inline Point2 operator+(Point2 a, Point2 b) { return {a.x_m + b.x_m, a.y_m + b.y_m}; }
inline Point2 operator-(Point2 a, Point2 b) { return {a.x_m - b.x_m, a.y_m - b.y_m}; }
inline Point2 operator*(double k, Point2 a) { return {k * a.x_m, k * a.y_m}; }
inline double dot(Point2 a, Point2 b) { return a.x_m * b.x_m + a.y_m * b.y_m; }
/// z of the cross product; > 0 when b lies to the left of a.
inline double cross(Point2 a, Point2 b) { return a.x_m * b.y_m - a.y_m * b.x_m; }
inline double norm(Point2 a) { return std::hypot(a.x_m, a.y_m); }
inline double distance(Point2 a, Point2 b) { return norm(a - b); }

/// Pose of a body in the hall frame (right-handed, x east, y north, heading counter-clockwise from
/// x in (-pi, pi]), or any planar rigid transform. The body frame is x forward, y to the LEFT.
struct Pose2 {
    double x_m = 0;
    double y_m = 0;
    double heading_rad = 0;

    Point2 position() const { return {x_m, y_m}; }
    friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// target_from_a * a_from_b = target_from_b; names chain by eye.
inline Pose2 operator*(const Pose2& a, const Pose2& b) {
    const double c = std::cos(a.heading_rad);
    const double s = std::sin(a.heading_rad);
    return {a.x_m + c * b.x_m - s * b.y_m, a.y_m + s * b.x_m + c * b.y_m,
            wrap(a.heading_rad + b.heading_rad)};
}
inline Point2 operator*(const Pose2& a, Point2 p) {
    const double c = std::cos(a.heading_rad);
    const double s = std::sin(a.heading_rad);
    return {a.x_m + c * p.x_m - s * p.y_m, a.y_m + s * p.x_m + c * p.y_m};
}
inline Pose2 inverse(const Pose2& a) {
    const double c = std::cos(a.heading_rad);
    const double s = std::sin(a.heading_rad);
    return {-c * a.x_m - s * a.y_m, s * a.x_m - c * a.y_m, wrap(-a.heading_rad)};
}

}  // namespace pulseline::geometry
