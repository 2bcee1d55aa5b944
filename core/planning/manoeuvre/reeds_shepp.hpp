#pragma once

#include <array>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace pulseline::planning {

/// One piece of a Reeds-Shepp path.
struct RsPiece {
    int steer = 0;      // +1 left, -1 right, 0 straight
    double length = 0;  // in turning radii; negative: driven backwards
};

/// Path of up to five pieces between two poses: arcs of the turning radius and straights.
struct RsPath {
    std::array<RsPiece, 5> pieces;
    int count = 0;
    double length = 0;  // in turning radii, of all pieces together
    int reversals = 0;  // changes between forwards and backwards
};

/// Pose after `length` of a piece from the origin, heading along x.
geometry::Pose2 rs_moved(const RsPiece& piece, double length);
/// Every path of the Reeds-Shepp words from the origin (heading along x) to `goal`, whose position
/// is in turning radii, shortest first; the first one is the shortest path there is.
/// Reeds, Shepp 1990, "Optimal paths for a car that goes both forwards and backwards", formulas
/// 8.1 to 8.11 with the corrections of 8.4 and 8.6 known from their implementations; each path is
/// driven once more to prove that it ends at the goal (1e-10), so a wrong branch is never given.
/// Never empty.
void reeds_shepp_paths(const geometry::Pose2& goal, std::vector<RsPath>& paths);
/// Length of the shortest one, in turning radii.
double reeds_shepp_length(const geometry::Pose2& goal);

}  // namespace pulseline::planning
