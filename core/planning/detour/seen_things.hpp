#pragma once

#include <vector>

#include "core/planning/room/standing_body.hpp"

namespace pulseline::planning {

/// What scanners have seen, as convex bodies to keep away from: points near each other are one
/// piece of at most kPiece_m, each point standing for a square of kPoint_m. Any frame, which is
/// also that of the answer. Deterministic, whatever the order of the points.
std::vector<StandingBody> seen_things(std::vector<geometry::Point2> points);

/// Small enough that the hull of a bent thing takes little floor that is free; a body with a
/// clearance of 0.2 m does not get in between two points of one wall anyway.
constexpr double kPiece_m = 0.6;
constexpr double kPoint_m = 0.03;

}  // namespace pulseline::planning
