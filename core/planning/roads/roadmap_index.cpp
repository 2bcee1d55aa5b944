#include "core/planning/roads/roadmap_index.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/primitives.hpp"
#include "core/planning/roads/code_reach.hpp"

namespace pulseline::planning {
namespace {

using geometry::Polygon;
using geometry::Pose2;

constexpr double kSameHeading_rad = 1e-6;
// Breaks ties towards driving forwards; far below any turn it could save.
constexpr double kBackwardsBurden = 0.01;

Polygon circle_around(geometry::Point2 centre, double radius_m) {
    constexpr int kCorners = 24;
    const double r = radius_m / std::cos(kPi / kCorners);
    Polygon circle;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * kPi * i / kCorners;
        circle.push_back(centre + geometry::Point2{r * std::cos(angle), r * std::sin(angle)});
    }
    return circle;
}

}  // namespace

Body body_of(const plant::VehicleType& type, bool loaded) {
    return {plant::outline_with_load(type, loaded), type.clearance_m};
}

RoadmapIndex::RoadmapIndex(const plant::Plant& plant) : plant_(plant), lines_(plant) {
    for (const plant::Hall& hall : plant.halls) obstacles_.emplace(hall.id, Obstacles(plant, hall));
    for (const plant::RoadmapNode& node : plant.nodes) {
        node_by_id_.emplace(node.id, graph_.add_node(node.position));
    }
    headings_.resize(graph_.nodes.size());
    for (std::size_t i = 0; i < plant.edges.size(); ++i) {
        const int from = node(plant.edges[i].from);
        const int to = node(plant.edges[i].to);
        if (from < 0 || to < 0 || from == to) continue;
        for (const bool backwards : {false, true}) {
            const int arc = graph_.add_arc(from, to, backwards);
            RoadArc& added = graph_.arcs[static_cast<std::size_t>(arc)];
            if (backwards) added.burden = kBackwardsBurden;
            edge_by_arc_.push_back(static_cast<int>(i));
            ends_.push_back(
                {heading_number(from, added.body_rad), heading_number(to, added.body_rad)});
        }
    }
}

int RoadmapIndex::heading_number(int node, double heading_rad) {
    auto& headings = headings_[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; i < headings.size(); ++i) {
        if (std::abs(wrap(headings[i] - heading_rad)) < kSameHeading_rad)
            return static_cast<int>(i);
    }
    headings.push_back(heading_rad);
    return static_cast<int>(headings.size()) - 1;
}

int RoadmapIndex::node(const plant::NodeId& id) const {
    const auto found = node_by_id_.find(id);
    return found == node_by_id_.end() ? -1 : found->second;
}

const plant::RoadmapNode& RoadmapIndex::node(int index) const {
    return plant_.nodes[static_cast<std::size_t>(index)];
}

const plant::RoadmapEdge& RoadmapIndex::edge_of_arc(int arc) const {
    return plant_.edges[static_cast<std::size_t>(edge_by_arc_[static_cast<std::size_t>(arc)])];
}

const Obstacles* RoadmapIndex::obstacles(const plant::HallId& hall) const {
    const auto found = obstacles_.find(hall);
    return found == obstacles_.end() ? nullptr : &found->second;
}

const Obstacles* RoadmapIndex::obstacles_of_node(int index) const {
    return obstacles(node(index).hall);
}

std::vector<Polygon> RoadmapIndex::swept(const Body& body, int arc) const {
    const RoadArc& lane = graph_.arcs[static_cast<std::size_t>(arc)];
    const auto& from = graph_.nodes[static_cast<std::size_t>(lane.from)];
    std::vector<kinematics::Segment> way;
    kinematics::append_straight(way, {from.x_m, from.y_m, lane.body_rad},
                                graph_.nodes[static_cast<std::size_t>(lane.to)]);
    return kinematics::sweep(body.pieces, way);
}

std::vector<char> RoadmapIndex::headings_in_use(const Passage& passage, int node) const {
    std::vector<char> used(headings_[static_cast<std::size_t>(node)].size(), 0);
    for (const int arc : graph_.out[static_cast<std::size_t>(node)]) {
        const auto i = static_cast<std::size_t>(arc);
        if (usable(passage, arc)) used[static_cast<std::size_t>(ends_[i].at_from)] = 1;
    }
    for (const int arc : graph_.in[static_cast<std::size_t>(node)]) {
        const auto i = static_cast<std::size_t>(arc);
        if (usable(passage, arc)) used[static_cast<std::size_t>(ends_[i].at_to)] = 1;
    }
    return used;
}

std::vector<char> RoadmapIndex::free_turns(const Passage& passage, int node) const {
    const Body& body = passage.body;
    const auto& headings = headings_[static_cast<std::size_t>(node)];
    const std::size_t count = headings.size();
    std::vector<char> free(count * count, 1);
    const Obstacles* obstacles = obstacles_of_node(node);
    if (!obstacles) return free;
    const auto limits = obstacles->limits(body.clearance_m);
    const auto& at = graph_.nodes[static_cast<std::size_t>(node)];
    if (obstacles->keeps({circle_around(at, plant::reach_m(body.pieces))}, limits)) return free;
    const auto used = headings_in_use(passage, node);
    for (std::size_t a = 0; a < count; ++a) {
        for (std::size_t b = 0; b < count; ++b) {
            if (a == b || !used[a] || !used[b]) continue;
            std::vector<kinematics::Segment> turn;
            kinematics::append_turn(turn, {at.x_m, at.y_m, headings[a]},
                                    kinematics::shortest_turn_rad(headings[a], headings[b]));
            free[a * count + b] = obstacles->keeps(kinematics::sweep(body.pieces, turn), limits);
        }
    }
    return free;
}

Passage RoadmapIndex::passage(const plant::VehicleType& type, bool loaded) const {
    Passage result;
    result.body = body_of(type, loaded);
    for (std::size_t i = 0; i < graph_.arcs.size(); ++i) {
        const int arc = static_cast<int>(i);
        const auto& types = edge_of_arc(arc).vehicle_types;
        result.arc_allowed.push_back(types.empty() ||
                                     std::find(types.begin(), types.end(), type.id) != types.end());
        const Obstacles* obstacles = obstacles_of_node(graph_.arcs[i].from);
        result.arc_free.push_back(
            !obstacles ||
            obstacles->keeps(swept(result.body, arc), obstacles->limits(type.clearance_m)));
    }
    for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
        result.turn_free.push_back(free_turns(result, static_cast<int>(i)));
    }
    if (plant_.routing.accuracy_k > 0) result.arc_sigma_m = sigmas(type, loaded);
    return result;
}

std::vector<double> RoadmapIndex::sigmas(const plant::VehicleType& type, bool loaded) const {
    const CodeReach reach(type, loaded);
    std::vector<double> sigmas;
    for (const RoadArc& arc : graph_.arcs) {
        const geometry::Point2 from = graph_.nodes[static_cast<std::size_t>(arc.from)];
        std::vector<kinematics::Segment> lane;
        kinematics::append_straight(lane, {from.x_m, from.y_m, arc.body_rad},
                                    graph_.nodes[static_cast<std::size_t>(arc.to)]);
        sigmas.push_back(
            lane.empty() ? 0 : reach.mean_sigma_m(plant_, node(arc.from).hall, lane.front()));
    }
    return sigmas;
}

bool RoadmapIndex::usable(const Passage& passage, int arc) const {
    const auto i = static_cast<std::size_t>(arc);
    return passage.arc_free[i] != 0 && passage.arc_allowed[i] != 0;
}

bool RoadmapIndex::may_follow(const Passage& passage, int arc, int next) const {
    const auto node = static_cast<std::size_t>(graph_.arcs[static_cast<std::size_t>(arc)].to);
    const auto a = static_cast<std::size_t>(ends_[static_cast<std::size_t>(arc)].at_to);
    const auto b = static_cast<std::size_t>(ends_[static_cast<std::size_t>(next)].at_from);
    return a == b || passage.turn_free[node][a * headings_[node].size() + b] != 0;
}

std::optional<Approach> RoadmapIndex::narrow_place(const Passage& passage, int arc) const {
    const Obstacles* obstacles = obstacles_of_node(graph_.arcs[static_cast<std::size_t>(arc)].from);
    if (!obstacles) return std::nullopt;
    return obstacles->violation(swept(passage.body, arc),
                                obstacles->limits(passage.body.clearance_m));
}

}  // namespace pulseline::planning
