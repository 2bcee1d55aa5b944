#pragma once

#include "core/planning/leg_planner.hpp"
#include "core/planning/roadmap_index.hpp"

namespace pulseline::planning {

/// One leg to plan, with everything looked up.
struct LegTask {
    const LegRequest& request;
    const plant::Station& station;
    const plant::RoutingCost& cost;
    const RoadmapIndex& roads;
    const Passage& passage;
    const Obstacles& obstacles;
    Obstacles::Limits limits;  // of this leg: its start may be tight
};

/// Segments and route of a leg before its swept area is checked.
struct LegDraft {
    std::vector<kinematics::Segment> segments;
    std::vector<plant::NodeId> route;
    int turns = 0;
    double cost = 0;
};

/// Least-cost way along the roadmap from the start pose to the station: straight lanes with turns
/// on the spot. Errors: no_route, footprint_too_large.
Result<LegDraft> draft_road_leg(const LegTask& task);

}  // namespace pulseline::planning
