#pragma once

#include <vector>

#include "core/planning/room/floor_field.hpp"

namespace pulseline::planning {

/// Lengths of the ways of a disc to a goal, round what stands on the floor: a guide for any body
/// that holds such a disc. On cells, 8-connected: up to 8 % longer than the shortest way, and more
/// through gaps of about the disc's width. Never blocked where some place in the cell is free for
/// the disc, so that no length at all proves that there is no way.
class DiscDistances {
public:
    DiscDistances(const FloorField& field, double disc_radius_m, geometry::Point2 goal);
    /// Infinite: no way from there.
    double from(geometry::Point2 at) const;

private:
    int cell(geometry::Point2 at) const;  // -1: outside

    double cell_m_;
    geometry::Point2 origin_;
    int width_ = 0;
    int height_ = 0;
    std::vector<double> length_m_;
};

}  // namespace pulseline::planning
