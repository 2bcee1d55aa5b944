#include "core/planning/legs/road_entry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/kinematics/primitives.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::append_straight;
using kinematics::append_turn;
using kinematics::shortest_turn_rad;
using Segments = std::vector<kinematics::Segment>;

constexpr std::size_t kConnections = 6;
constexpr double kOnNode_m = 0.01;  // nearer than this there is no way to it

double turned(const Segments& segments) {
    double sum = 0;
    for (const auto& segment : segments) sum += std::abs(segment.turn_rad);
    return sum;
}

bool is_free(const LegTask& task, const Segments& segments) {
    return task.obstacles.keeps(kinematics::sweep(task.passage.body.pieces, segments), task.limits);
}

/// The body's heading on an arc that is driven from `start` instead of its first node.
double heading_from(const RoadGraph& graph, const RoadArc& arc, Point2 start) {
    const Point2 way = graph.nodes[static_cast<std::size_t>(arc.to)] - start;
    const bool backwards = std::abs(wrap(arc.body_rad - arc.heading_rad)) > kPi / 2;
    return wrap(std::atan2(way.y_m, way.x_m) + (backwards ? kPi : 0));
}

/// Arcs out of the node at which the vehicle stands.
std::vector<RoadEntry> enter_at(const LegTask& task, int node) {
    const RoadGraph& graph = task.roads.graph();
    const Pose2& start = task.request.start;
    std::vector<RoadEntry> entries;
    for (const int index : graph.out[static_cast<std::size_t>(node)]) {
        if (!task.roads.usable(task.passage, index)) continue;
        const RoadArc& arc = graph.arcs[static_cast<std::size_t>(index)];
        const double heading = heading_from(graph, arc, start.position());
        if (!is_free_turn(task, start, heading)) continue;
        const double turn = std::abs(shortest_turn_rad(start.heading_rad, heading));
        entries.push_back({{index, 0, turn > task.cost.turn_threshold_rad, turn}, {}, 0});
    }
    return entries;
}

/// Straight to a node first, forwards or backwards, then onto its arcs.
std::vector<RoadEntry> connect_to(const LegTask& task, int node) {
    const RoadGraph& graph = task.roads.graph();
    const Pose2& start = task.request.start;
    const Point2 at = graph.nodes[static_cast<std::size_t>(node)];
    const Point2 way = at - start.position();
    const double travel = std::atan2(way.y_m, way.x_m);
    std::vector<RoadEntry> entries;
    for (const bool backwards : {false, true}) {
        const double heading = wrap(travel + (backwards ? kPi : 0));
        Segments segments;
        append_turn(segments, start, shortest_turn_rad(start.heading_rad, heading));
        append_straight(segments, {start.x_m, start.y_m, heading}, at);
        if (!is_free(task, segments)) continue;
        const bool first_turn = is_turn(task.cost, start.heading_rad, heading);
        const double cost = edge_cost(task.cost, norm(way), first_turn);
        for (const int index : graph.out[static_cast<std::size_t>(node)]) {
            if (!task.roads.usable(task.passage, index)) continue;
            const RoadArc& arc = graph.arcs[static_cast<std::size_t>(index)];
            const Pose2 there{at.x_m, at.y_m, heading};
            if (!is_free_turn(task, there, arc.body_rad)) continue;
            const double burden = turned(segments) + std::abs(wrap(arc.body_rad - heading));
            entries.push_back({{index, cost, is_turn(task.cost, travel, arc.heading_rad), burden},
                               segments,
                               first_turn ? 1 : 0});
        }
    }
    return entries;
}

/// Nodes of the vehicle's hall within kConnect_m and how far away each is, the nearest first.
std::vector<std::pair<double, int>> nodes_near(const LegTask& task) {
    const RoadGraph& graph = task.roads.graph();
    std::vector<std::pair<double, int>> near;
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        if (task.roads.node(static_cast<int>(i)).hall != task.request.hall) continue;
        const double away_m = geometry::distance(graph.nodes[i], task.request.start.position());
        if (away_m <= kConnect_m) near.push_back({away_m, static_cast<int>(i)});
    }
    std::sort(near.begin(), near.end());
    return near;
}

}  // namespace

bool is_free_turn(const LegTask& task, const Pose2& from, double to_rad) {
    Segments turn;
    append_turn(turn, from, shortest_turn_rad(from.heading_rad, to_rad));
    return is_free(task, turn);
}

std::vector<std::vector<RoadEntry>> road_entries_by_node(const LegTask& task) {
    std::vector<std::vector<RoadEntry>> by_node;
    for (const auto& [away_m, node] : nodes_near(task)) {
        if (by_node.size() == kConnections) break;
        if (away_m < kOnNode_m) continue;
        auto entries = connect_to(task, node);
        if (!entries.empty()) by_node.push_back(std::move(entries));
    }
    return by_node;
}

std::vector<RoadEntry> road_entries(const LegTask& task) {
    const auto near = nodes_near(task);
    if (!near.empty() && near.front().first <= kAtNode_m) {
        return enter_at(task, near.front().second);
    }
    std::vector<RoadEntry> entries;
    for (auto& to_node : road_entries_by_node(task)) {
        std::ranges::move(to_node, std::back_inserter(entries));
    }
    return entries;
}

}  // namespace pulseline::planning
