#pragma once

#include <optional>
#include <vector>

#include "core/planning/legs/grid_floor.hpp"
#include "core/planning/legs/road_leg.hpp"

namespace pulseline::planning {

/// A drivable leg along a line over free floor: turns on the spot and straights, for a type that
/// moves in any direction also straights with the heading that it starts or is to stand with.
/// Of the chains over some of the `points`, in their order, the one of least cost that keeps clear,
/// then of fewest straights and least turning; nullopt: none that keeps clear costs less than
/// `most_cost`.
/// REQUIRES: the first point is the request's start, the last the station's place; at most
/// kMostPoints.
std::optional<LegDraft> draft_along(const LegTask& task, const GridFloor& floor,
                                    const std::vector<geometry::Point2>& points, double most_cost);
constexpr std::size_t kMostPoints = 64;

/// Where the draft's straights begin and end.
std::vector<geometry::Point2> corners_of(const LegDraft& draft);

/// Whether the exact footprint check finds the motion free, on floor that is not closed.
bool keeps_clear(const LegTask& task, const GridFloor& floor,
                 const std::vector<kinematics::Segment>& segments);

}  // namespace pulseline::planning
