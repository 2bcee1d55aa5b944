#pragma once

#include "core/planning/legs/leg_planner.hpp"
#include "core/planning/roads/leg_roads.hpp"
#include "core/planning/roads/roadmap_index.hpp"

namespace pulseline::planning {

class CodeReach;

/// One leg to plan, with everything looked up.
struct LegTask {
    const plant::Plant& plant;
    const LegRequest& request;
    plant::Station station;  // one without a name or a node for a pose
    const plant::RoutingCost& cost;
    const RoadmapIndex& roads;
    const Passage& passage;
    const CodeReach& reach;
    LegRoads& lanes;
    const std::vector<ClosedFloor>& closures;
    const Obstacles& obstacles;
    Obstacles::Limits limits;  // of this leg: its start may be tight
};

/// Segments and route of a leg before its swept area is checked.
struct LegDraft {
    std::vector<kinematics::Segment> segments;
    std::vector<double> max_speed_mps;  // as set_durations takes it
    std::vector<plant::NodeId> route;
    int turns = 0;
    double cost = 0;
    double accuracy = 0;                // of the cost, for driving where its place is uncertain
    std::vector<std::size_t> closures;  // driven over: a smallest set to reopen
};

/// Least-cost way along the roadmap from the start pose to the station: straight lanes with turns
/// on the spot. Round closed floor where there is another way, else over it, and `closures` says
/// what would have to be reopened. Errors: no_route, footprint_too_large.
Result<LegDraft> draft_road_leg(const LegTask& task);

/// Up to `count` other legs, by cost, that differ sufficiently from one along the nodes of `route`
/// and from each other, none over closed floor.
std::vector<LegDraft> draft_other_road_legs(const LegTask& task,
                                            const std::vector<plant::NodeId>& route, int count);

}  // namespace pulseline::planning
