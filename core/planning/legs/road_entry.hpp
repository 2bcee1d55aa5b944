#pragma once

#include <vector>

#include "core/planning/legs/road_leg.hpp"
#include "core/planning/roads/road_search.hpp"

namespace pulseline::planning {

/// A vehicle this near to a node stands at it.
inline constexpr double kAtNode_m = 0.5;
/// How far a vehicle off the roadmap looks for a node.
inline constexpr double kConnect_m = 30.0;

/// How a vehicle gets from where it stands onto an arc.
struct RoadEntry {
    FirstArc first;
    std::vector<kinematics::Segment> segments;  // up to the arc's first node; none if it is there
    int turns = 0;                              // on those
};

/// Whether the body has room for a turn on the spot.
bool is_free_turn(const LegTask& task, const geometry::Pose2& from, double to_rad);

/// Ways onto the roadmap: from the node at which the vehicle stands, else straight to each of a few
/// nodes near it.
std::vector<RoadEntry> road_entries(const LegTask& task);

/// For each of a few nodes near the vehicle, the nearest first, the ways straight to it and on. A
/// vehicle that stands beside a node drives to it first, so that its lanes' codes pass below it.
std::vector<std::vector<RoadEntry>> road_entries_by_node(const LegTask& task);

}  // namespace pulseline::planning
