#pragma once

#include <cmath>

#include "core/geometry/pose2.hpp"

namespace pulseline::geometry {

/// Direction from one point to another, counter-clockwise from +x in (-pi, pi]; 0 when they are the
/// same. Wang counts his angles from +Y in [0, 2 pi) and has a table of four cases for each: they
/// are this less pi/2, which holds where his cases divide by 0, too: his pose angle beta (4.2) from
/// receiver 4 to receiver 1 (localisation::pose_by_two), his target angle gamma (4.3) from the
/// vehicle's middle to its target. In gamma's cases y1 is a misprint of y0.
inline double bearing_rad(Point2 from, Point2 to) {
    return std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
}

/// Direction, seen from the body, of a move straight to `target` with unchanged heading: 0 ahead,
/// counter-clockwise, in (-pi, pi]. Wang's gamma less his beta: the yaw angle of his section 3.
inline double move_direction_rad(const Pose2& from, Point2 target) {
    return wrap(bearing_rad(from.position(), target) - from.heading_rad);
}

}  // namespace pulseline::geometry
