#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/result.hpp"
#include "core/planning/search/routing_cost.hpp"
#include "core/plant/plant.hpp"

/// Direction-penalised A* on a graph of straight lanes (Li 2022 eq. 10, corrected): the state is
/// the lane just driven, so every change of direction is seen and the result is exact.
namespace pulseline::planning {

/// A lane as it may be driven. Plain searches leave the body out of it; a lane that may be driven
/// forwards or backwards is two arcs.
struct RoadArc {
    int from = 0;
    int to = 0;
    double length_m = 0;
    double heading_rad = 0;  // of travel
    double body_rad = 0;     // of the vehicle
    double burden = 0;       // decides between routes of equal cost
};

struct RoadGraph {
    std::vector<geometry::Point2> nodes;
    std::vector<RoadArc> arcs;
    std::vector<std::vector<int>> out;  // arcs by node
    std::vector<std::vector<int>> in;

    int add_node(geometry::Point2 position);
    int add_arc(int from, int to, bool backwards = false);
};

/// One arc to begin with, and what it costs to get onto it (its own way not counted).
struct FirstArc {
    int arc = 0;
    double cost = 0;
    bool turn = false;  // a change of direction before it: charged like any other
    double burden = 0;
};

struct RoadQuery {
    std::vector<FirstArc> first;
    int goal = 0;
    std::function<bool(int arc)> usable;                // none: all
    std::function<bool(int arc, int next)> may_follow;  // none: all
    /// What an arc costs besides its way and turn, at least 0; none: nothing.
    std::function<double(int arc)> besides = {};
    std::function<std::optional<double>(int arc)>
        ending;  // burden of stopping there; nullopt: may not
    /// Lower bound of what is left after an arc, infinite where no way leads on; none: from the
    /// geometry. The nearer to the truth, the fewer arcs are looked at; the answer is the same.
    std::function<double(int arc)> left;
    const std::atomic<bool>* cancel = nullptr;  // set by anyone; then there is no route
};

struct RoadPath {
    double cost = 0;
    double length_m = 0;
    int turns = 0;
    int expanded = 0;
    std::vector<int> arcs;
};

/// Least cost, then least burden; nullopt without a route. REQUIRES: check(cost) passed.
std::optional<RoadPath> search_road(const RoadGraph& graph, const plant::RoutingCost& cost,
                                    const RoadQuery& query);

/// Least-cost path from node to node; arrival heading free, start heading free when not given.
/// Errors: routing_cost_invalid, unknown_node, no_route.
Result<RoadPath> find_path(const RoadGraph& graph, const plant::RoutingCost& cost, int from, int to,
                           std::optional<double> start_heading_rad = std::nullopt,
                           const std::function<bool(int)>& usable = {});

}  // namespace pulseline::planning
