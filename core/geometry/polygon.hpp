#pragma once

#include <vector>

#include "core/geometry/pose2.hpp"

namespace pulseline::geometry {

/// Simple polygon, counter-clockwise, not closed (the last point is not the first again).
using Polygon = std::vector<Point2>;

struct Box {
    Point2 min;
    Point2 max;
};

Polygon transformed(const Pose2& target_from_polygon, const Polygon& polygon);
Box bounding_box(const Polygon& polygon);
double area_m2(const Polygon& polygon);
bool contains(const Polygon& polygon, Point2 point);
/// True when the polygons share a point (touching counts).
bool intersects(const Polygon& a, const Polygon& b);
/// Whether the straight way leads through an edge; one that only touches it does not.
bool crosses(const Polygon& polygon, Point2 from, Point2 to);
/// Smallest distance between two polygons; 0 when they meet.
double distance(const Polygon& a, const Polygon& b);
/// Of a point from a polygon; 0 in it.
double distance(const Polygon& polygon, Point2 point);
/// > 0 when counterclockwise.
double signed_area(const Polygon& polygon);
Polygon convex_hull(std::vector<Point2> points);
/// Rectangle length x width about its centre, x along the length.
Polygon rectangle(double length_m, double width_m);
/// Outline of the union of overlapping convex pieces; several rings only when they do not touch.
/// Holes are dropped: a hole inside a swept area is no place for anybody.
std::vector<Polygon> union_outline(const std::vector<Polygon>& convex_pieces);

}  // namespace pulseline::geometry
