#pragma once

#include <vector>

#include "core/geometry/polygon.hpp"

namespace pulseline::geometry {

/// True when no two edges cross or overlap, no two points coincide and there are at least three.
bool is_simple(const Polygon& polygon);
/// The polygon cut into convex pieces that share edges: ear clipping, then triangles joined back
/// over diagonals that leave no reflex corner (Hertel and Mehlhorn 1983: at most four times the
/// least number of pieces). A polygon that is not simple comes back as its convex hull.
std::vector<Polygon> convex_pieces(const Polygon& polygon);
/// What of a convex polygon lies in the box (Sutherland and Hodgman 1974); empty when nothing does.
Polygon clipped(const Polygon& convex, const Box& box);

}  // namespace pulseline::geometry
