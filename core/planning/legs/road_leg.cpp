#include "core/planning/legs/road_leg.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/kinematics/primitives.hpp"
#include "core/planning/legs/blind_way.hpp"
#include "core/planning/legs/road_entry.hpp"
#include "core/planning/roads/road_alternatives.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::append_straight;
using kinematics::append_turn;
using kinematics::shortest_turn_rad;
using Segments = std::vector<kinematics::Segment>;
using Entries = std::vector<RoadEntry>;

constexpr double kMostAlternativeCost = 3;  // a hall has few ways: the long one counts, too

/// Where the last lane ends: at the station itself when its node lies there.
Point2 last_point(const LegTask& task, int goal) {
    const Point2 node = task.roads.graph().nodes[static_cast<std::size_t>(goal)];
    const Point2 station = task.station.pose.position();
    return geometry::distance(node, station) <= kAtNode_m ? station : node;
}

void append_move(Segments& segments, Pose2& pose, double heading_rad, Point2 target) {
    append_turn(segments, pose, shortest_turn_rad(pose.heading_rad, heading_rad));
    append_straight(segments, {pose.x_m, pose.y_m, heading_rad}, target);
    pose = {target.x_m, target.y_m, heading_rad};
}

/// What driving an arc costs because the vehicle's place is uncertain there.
double accuracy_cost(const LegTask& task, int arc) {
    const double length_m = task.roads.graph().arcs[static_cast<std::size_t>(arc)].length_m;
    return task.cost.accuracy_k * task.passage.sigma_m(arc) * length_m;
}

LegDraft drive(const LegTask& task, const RoadEntry& entry, const RoadPath& path, int goal) {
    const RoadGraph& graph = task.roads.graph();
    LegDraft draft;
    Segments& segments = draft.segments;
    std::vector<double> speeds;
    segments = entry.segments;
    Pose2 pose = segments.empty() ? task.request.start : segments.back().end;
    draft.route.push_back(
        task.roads.node(graph.arcs[static_cast<std::size_t>(path.arcs[0])].from).id);
    speeds.resize(segments.size(), 0);
    for (std::size_t i = 0; i < path.arcs.size(); ++i) {
        const RoadArc& arc = graph.arcs[static_cast<std::size_t>(path.arcs[i])];
        const Point2 target = i + 1 == path.arcs.size()
                                  ? last_point(task, goal)
                                  : graph.nodes[static_cast<std::size_t>(arc.to)];
        const Point2 way = target - pose.position();
        const bool backwards = std::abs(wrap(arc.body_rad - arc.heading_rad)) > kPi / 2;
        // A start beside its node bends the first lane a little; elsewhere the lane rules.
        const double heading = wrap(std::atan2(way.y_m, way.x_m) + (backwards ? kPi : 0));
        append_move(segments, pose, heading, target);
        draft.route.push_back(task.roads.node(arc.to).id);
        speeds.resize(segments.size(), task.roads.edge_of_arc(path.arcs[i]).max_speed_mps);
    }
    const Point2 rest = task.station.pose.position() - pose.position();
    if (norm(rest) > kinematics::kNothing) {
        const double ahead = std::atan2(rest.y_m, rest.x_m);
        const bool backwards = std::abs(wrap(ahead - pose.heading_rad)) > kPi / 2;
        append_move(segments, pose, wrap(ahead + (backwards ? kPi : 0)),
                    task.station.pose.position());
    }
    append_turn(segments, pose, shortest_turn_rad(pose.heading_rad, task.station.pose.heading_rad));
    speeds.resize(segments.size(), 0);
    kinematics::set_durations(*task.request.type, segments, speeds);
    draft.max_speed_mps = std::move(speeds);
    draft.cost = path.cost;
    for (const int arc : path.arcs) draft.accuracy += accuracy_cost(task, arc);
    draft.turns = path.turns + entry.turns;
    return draft;
}

RoadQuery query_of(const LegTask& task, const Entries& entries, int goal) {
    RoadQuery query;
    query.goal = goal;
    for (const RoadEntry& entry : entries) query.first.push_back(entry.first);
    query.may_follow = [&task](int arc, int next) {
        return task.roads.may_follow(task.passage, arc, next);
    };
    query.besides = [&task](int arc) { return accuracy_cost(task, arc); };
    query.ending = [&task, goal](int arc) -> std::optional<double> {
        const double body = task.roads.graph().arcs[static_cast<std::size_t>(arc)].body_rad;
        const Point2 at = last_point(task, goal);
        if (!is_free_turn(task, {at.x_m, at.y_m, body}, task.station.pose.heading_rad)) {
            return std::nullopt;
        }
        return std::abs(wrap(task.station.pose.heading_rad - body));
    };
    return query;
}

/// Why the search found nothing: the first lane in the way on the route that a small vehicle of any
/// type would take.
Error no_route(const LegTask& task, int goal, bool entered) {
    const RoadGraph& graph = task.roads.graph();
    Error error{
        Errc::kUnreachable,
        {"no_route", {{"from", task.request.from_station.str()}, {"to", task.station.id.str()}}},
        "No way along the roadmap leads to station " + std::to_string(task.station.number) +
            " for this vehicle.",
        {}};
    int start = -1;
    double least = kConnect_m;
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        if (task.roads.node(static_cast<int>(i)).hall != task.request.hall) continue;
        const double away = geometry::distance(graph.nodes[i], task.request.start.position());
        if (away <= least) {
            least = away;
            start = static_cast<int>(i);
        }
    }
    if (start < 0 || goal < 0) {
        error.reason.params.push_back({"blocked_by", std::string("no_node_near")});
        error.what += " There is no roadmap node near it; add one.";
        return error;
    }
    const auto path = find_path(graph, task.cost, start, goal);
    if (!path) {
        error.what += " Add lanes between its node and the rest of the roadmap.";
        return error;
    }
    for (const int arc : path->arcs) {
        const std::string edge = task.roads.edge_of_arc(arc).id.str();
        if (!task.passage.arc_allowed[static_cast<std::size_t>(arc)]) {
            error.reason.params.push_back({"blocked_by", edge});
            error.what += " Lane " + edge + " is not for vehicles of its type.";
            return error;
        }
        if (task.passage.arc_free[static_cast<std::size_t>(arc)]) continue;
        const auto place = task.roads.narrow_place(task.passage, arc).value_or(Approach{});
        return {Errc::kUnreachable,
                {"footprint_too_large",
                 {{"edge", edge},
                  {"by", place.what},
                  {"clearance_m", place.distance_m},
                  {"limit_m", task.passage.body.clearance_m}}},
                "The vehicle is too large for lane " + edge +
                    ". Send a smaller vehicle or clear the lane.",
                {}};
    }
    // Every lane is wide enough: it is a turn that is not free.
    error.reason.params.push_back(
        {"blocked_by", std::string(entered ? "no_room_to_turn" : "no_way_onto_roadmap")});
    error.what += entered ? " It cannot turn where it would have to."
                          : " It cannot turn and drive from where it stands onto a lane.";
    return error;
}

using Open = std::function<bool(int arc)>;

/// The least-cost leg over usable arcs that are open. `left` is REQUIRED to hold for these.
std::optional<LegDraft> draft_over(const LegTask& task, const Entries& entries, int goal,
                                   const Open& open, const LegRoads::Left* left) {
    RoadQuery query = query_of(task, entries, goal);
    query.usable = [&](int arc) { return task.roads.usable(task.passage, arc) && open(arc); };
    if (left) query.left = [left](int arc) { return left->after(arc); };
    const auto path = search_road(task.roads.graph(), task.cost, query);
    if (!path) return std::nullopt;
    // Several entries may lead onto the first arc: the search took the cheapest.
    const auto rank = [&](const RoadEntry& entry) {
        const double length =
            task.roads.graph().arcs[static_cast<std::size_t>(entry.first.arc)].length_m;
        return std::pair(entry.first.cost + edge_cost(task.cost, length, entry.first.turn),
                         entry.first.burden);
    };
    const RoadEntry* chosen = nullptr;
    for (const RoadEntry& entry : entries) {
        if (entry.first.arc != path->arcs.front()) continue;
        if (!chosen || rank(entry) < rank(*chosen)) chosen = &entry;
    }
    return drive(task, *chosen, *path, goal);
}

/// The least-cost leg that leads by a node near the vehicle first and on which it does not lose
/// itself. From beside a lane the shortest way onto the roadmap misses its codes.
std::optional<LegDraft> draft_past_codes(const LegTask& task, int goal, const Open& open,
                                         const LegRoads::Left& left) {
    std::optional<LegDraft> best;
    for (const Entries& entries : road_entries_by_node(task)) {
        auto leg = draft_over(task, entries, goal, open, &left);
        if (!leg || (best && best->cost <= leg->cost)) continue;
        if (!blind_way(task, leg->segments).loses_itself()) best = std::move(leg);
    }
    return best;
}

/// The leg when some closures are reopened.
std::optional<LegDraft> draft_reopened(const LegTask& task, const Entries& entries, int goal,
                                       const std::set<std::size_t>& reopened) {
    auto leg = draft_over(
        task, entries, goal,
        [&](int arc) {
            const auto& over = task.lanes.closures_on(arc);
            return std::all_of(over.begin(), over.end(),
                               [&](std::size_t closure) { return reopened.contains(closure); });
        },
        nullptr);
    if (leg) leg->closures.assign(reopened.begin(), reopened.end());
    return leg;
}

/// A leg for which as little as possible has to be reopened: one closure, the one that leaves the
/// least cost; else a set of which none may be left out.
std::optional<LegDraft> draft_over_closed_floor(const LegTask& task, const Entries& entries,
                                                int goal) {
    std::set<std::size_t> in_the_way;
    for (int arc = 0; arc < static_cast<int>(task.roads.graph().arcs.size()); ++arc) {
        const auto& over = task.lanes.closures_on(arc);
        in_the_way.insert(over.begin(), over.end());
    }
    if (in_the_way.empty()) return std::nullopt;
    auto best = draft_reopened(task, entries, goal, in_the_way);
    if (!best) return std::nullopt;
    std::optional<LegDraft> with_one;
    for (const std::size_t closure : in_the_way) {
        auto leg = draft_reopened(task, entries, goal, {closure});
        if (leg && (!with_one || leg->cost < with_one->cost)) with_one = std::move(leg);
    }
    if (with_one) return with_one;
    std::set<std::size_t> reopened = in_the_way;
    for (const std::size_t closure : in_the_way) {
        reopened.erase(closure);
        if (auto leg = draft_reopened(task, entries, goal, reopened)) {
            best = std::move(leg);
        } else {
            reopened.insert(closure);
        }
    }
    return best;
}

/// Any arcs along the nodes; forwards or backwards is no other route.
std::vector<int> arcs_along(const RoadmapIndex& roads, const std::vector<plant::NodeId>& route) {
    std::vector<int> arcs;
    for (std::size_t i = 0; i + 1 < route.size(); ++i) {
        const int from = roads.node(route[i]);
        const int to = roads.node(route[i + 1]);
        for (const int arc : roads.graph().out[static_cast<std::size_t>(from)]) {
            if (roads.graph().arcs[static_cast<std::size_t>(arc)].to != to) continue;
            arcs.push_back(arc);
            break;
        }
    }
    return arcs;
}

}  // namespace

Result<LegDraft> draft_road_leg(const LegTask& task) {
    if (const auto ok = check(task.cost); !ok) return fail(ok.error());
    const int goal = task.roads.node(task.station.node);
    if (goal < 0) return fail(no_route(task, goal, false));
    const auto entries = road_entries(task);
    const auto left = task.lanes.left(goal);
    const auto open = [&](int arc) { return !task.lanes.closed(arc); };
    if (auto leg = draft_over(task, entries, goal, open, &left)) {
        if (!blind_way(task, leg->segments).loses_itself()) return std::move(*leg);
        if (auto surer = draft_past_codes(task, goal, open, left)) return std::move(*surer);
        return std::move(*leg);
    }
    if (auto leg = draft_over_closed_floor(task, entries, goal)) return std::move(*leg);
    return fail(no_route(task, goal, !entries.empty()));
}

std::vector<LegDraft> draft_other_road_legs(const LegTask& task,
                                            const std::vector<plant::NodeId>& route, int count) {
    const int goal = task.roads.node(task.station.node);
    if (!check(task.cost) || goal < 0) return {};
    const RoadGraph& graph = task.roads.graph();
    const auto entries = road_entries(task);
    std::vector<RoadSeed> seeds;
    for (const RoadEntry& entry : entries) {
        const double length = graph.arcs[static_cast<std::size_t>(entry.first.arc)].length_m;
        seeds.push_back(
            {entry.first.arc,
             task.lanes.counted(entry.first.cost + edge_cost(task.cost, length, entry.first.turn) +
                                accuracy_cost(task, entry.first.arc))});
    }
    RoadRoute chosen;
    chosen.arcs = arcs_along(task.roads, route);
    const auto routes = other_routes(task.lanes.router(), task.lanes.user(), seeds, goal, chosen,
                                     {.count = count, .most_cost = kMostAlternativeCost});
    const auto left = task.lanes.left(goal);
    std::vector<LegDraft> legs;
    for (const RoadRoute& other : routes) {
        std::set<std::pair<int, int>> lanes;
        for (const int arc : other.arcs) {
            const RoadArc& lane = graph.arcs[static_cast<std::size_t>(arc)];
            lanes.insert({lane.from, lane.to});
        }
        // Which lanes of the route are driven backwards is decided as for any leg.
        const auto open = [&](int arc) {
            const RoadArc& lane = graph.arcs[static_cast<std::size_t>(arc)];
            return lanes.contains({lane.from, lane.to}) && !task.lanes.closed(arc);
        };
        if (auto leg = draft_over(task, entries, goal, open, &left)) legs.push_back(*leg);
    }
    return legs;
}

}  // namespace pulseline::planning
