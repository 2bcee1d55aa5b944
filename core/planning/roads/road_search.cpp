#include "core/planning/roads/road_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace pulseline::planning {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct ArcLabel {
    double cost = kInfinite;
    double burden = kInfinite;
    int before = -1;
    bool turn = false;
};

struct OpenArc {
    double estimate;
    double burden;
    double cost;
    int arc;
    bool operator<(const OpenArc& other) const {  // std::priority_queue takes the greatest first
        if (estimate != other.estimate) return estimate > other.estimate;
        if (burden != other.burden) return burden > other.burden;
        return arc > other.arc;
    }
};

/// Lower bound of what is left after an arc: k x straight line, and one change of direction unless
/// straight continuation alone can reach the goal. Consistent: a step without a change keeps the
/// answer of that test, and a step with one pays for it.
class Bound {
public:
    Bound(const RoadGraph& graph, const plant::RoutingCost& cost, const RoadQuery& query)
        : graph_(graph),
          left_(query.left),
          goal_(graph.nodes[static_cast<std::size_t>(query.goal)]) {
        if (left_) return;
        charge_ = arc_charge(cost);
        rate_ = cost.k_same;
        if (charge_ < 0) {
            double shortest = kInfinite;
            for (const RoadArc& arc : graph.arcs) shortest = std::min(shortest, arc.length_m);
            rate_ = shortest > 0 ? std::max(0.0, cost.k_same + charge_ / shortest) : 0;
            charge_ = 0;
        }
        if (charge_ > 0) mark_straight(cost, query);
    }

    double after(int arc) const {
        if (left_) return left_(arc);
        const auto i = static_cast<std::size_t>(arc);
        const auto to = static_cast<std::size_t>(graph_.arcs[i].to);
        // Rounding must not lift the bound above the truth.
        const double way = geometry::distance(graph_.nodes[to], goal_) * (1 - 1e-12);
        return rate_ * way + (charge_ > 0 && !straight_[i] ? charge_ : 0);
    }

private:
    static double arc_charge(const plant::RoutingCost& cost) {
        return (cost.k_diff - cost.k_same) * cost.reference_step_m;
    }

    void mark_straight(const plant::RoutingCost& cost, const RoadQuery& query) {
        straight_.assign(graph_.arcs.size(), false);
        std::vector<int> open;
        const auto mark = [&](int arc) {
            const auto i = static_cast<std::size_t>(arc);
            if (straight_[i] || (query.usable && !query.usable(arc))) return;
            straight_[i] = true;
            open.push_back(arc);
        };
        for (const int arc : graph_.in[static_cast<std::size_t>(query.goal)]) mark(arc);
        while (!open.empty()) {
            const RoadArc& next = graph_.arcs[static_cast<std::size_t>(open.back())];
            open.pop_back();
            for (const int arc : graph_.in[static_cast<std::size_t>(next.from)]) {
                const RoadArc& before = graph_.arcs[static_cast<std::size_t>(arc)];
                if (!is_turn(cost, before.heading_rad, next.heading_rad)) mark(arc);
            }
        }
    }

    const RoadGraph& graph_;
    const std::function<double(int)>& left_;
    geometry::Point2 goal_;
    double rate_ = 0;
    double charge_ = 0;
    std::vector<bool> straight_;
};

RoadPath path_to(const RoadGraph& graph, const std::vector<ArcLabel>& labels, int last,
                 int expanded) {
    RoadPath path;
    path.cost = labels[static_cast<std::size_t>(last)].cost;
    path.expanded = expanded;
    for (int arc = last; arc >= 0; arc = labels[static_cast<std::size_t>(arc)].before) {
        path.arcs.push_back(arc);
        path.length_m += graph.arcs[static_cast<std::size_t>(arc)].length_m;
        path.turns += labels[static_cast<std::size_t>(arc)].turn ? 1 : 0;
    }
    std::reverse(path.arcs.begin(), path.arcs.end());
    return path;
}

}  // namespace

int RoadGraph::add_node(geometry::Point2 position) {
    nodes.push_back(position);
    out.emplace_back();
    in.emplace_back();
    return static_cast<int>(nodes.size()) - 1;
}

int RoadGraph::add_arc(int from, int to, bool backwards) {
    const geometry::Point2 way =
        nodes[static_cast<std::size_t>(to)] - nodes[static_cast<std::size_t>(from)];
    RoadArc arc;
    arc.from = from;
    arc.to = to;
    arc.length_m = norm(way);
    arc.heading_rad = std::atan2(way.y_m, way.x_m);
    arc.body_rad = backwards ? wrap(arc.heading_rad + kPi) : arc.heading_rad;
    const int index = static_cast<int>(arcs.size());
    arcs.push_back(arc);
    out[static_cast<std::size_t>(from)].push_back(index);
    in[static_cast<std::size_t>(to)].push_back(index);
    return index;
}

std::optional<RoadPath> search_road(const RoadGraph& graph, const plant::RoutingCost& cost,
                                    const RoadQuery& query) {
    const Bound bound(graph, cost, query);
    const int final_label =
        static_cast<int>(graph.arcs.size());  // stands for "stopped at the goal"
    std::vector<ArcLabel> labels(graph.arcs.size() + 1);
    std::priority_queue<OpenArc> open;
    const auto reach = [&](int arc, double arc_total, double burden, int before, bool turn) {
        ArcLabel& label = labels[static_cast<std::size_t>(arc)];
        if (arc_total > label.cost || (arc_total == label.cost && burden >= label.burden)) return;
        const double left = arc == final_label ? 0 : bound.after(arc);
        if (left == kInfinite) return;
        label = {arc_total, burden, before, turn};
        open.push({arc_total + left, burden, arc_total, arc});
    };
    const auto besides = [&](int arc) { return query.besides ? query.besides(arc) : 0; };
    for (const FirstArc& first : query.first) {
        if (query.usable && !query.usable(first.arc)) continue;
        const RoadArc& arc = graph.arcs[static_cast<std::size_t>(first.arc)];
        reach(first.arc,
              first.cost + edge_cost(cost, arc.length_m, first.turn) + besides(first.arc),
              first.burden + arc.burden, -1, first.turn);
    }
    int expanded = 0;
    while (!open.empty() && !(query.cancel && *query.cancel)) {
        const OpenArc top = open.top();
        open.pop();
        const ArcLabel label = labels[static_cast<std::size_t>(top.arc)];
        if (top.cost != label.cost || top.burden != label.burden) continue;  // found better since
        if (top.arc == final_label) return path_to(graph, labels, label.before, expanded);
        ++expanded;
        const RoadArc& arc = graph.arcs[static_cast<std::size_t>(top.arc)];
        if (arc.to == query.goal) {
            const auto burden = query.ending ? query.ending(top.arc) : 0.0;
            if (burden) reach(final_label, label.cost, label.burden + *burden, top.arc, false);
        }
        for (const int next : graph.out[static_cast<std::size_t>(arc.to)]) {
            if (query.usable && !query.usable(next)) continue;
            if (query.may_follow && !query.may_follow(top.arc, next)) continue;
            const RoadArc& to = graph.arcs[static_cast<std::size_t>(next)];
            const bool turn = is_turn(cost, arc.heading_rad, to.heading_rad);
            reach(next, label.cost + edge_cost(cost, to.length_m, turn) + besides(next),
                  label.burden + to.burden + std::abs(wrap(to.body_rad - arc.body_rad)), top.arc,
                  turn);
        }
    }
    return std::nullopt;
}

Result<RoadPath> find_path(const RoadGraph& graph, const plant::RoutingCost& cost, int from, int to,
                           std::optional<double> start_heading_rad,
                           const std::function<bool(int)>& usable) {
    if (const auto ok = check(cost); !ok) return fail(ok.error());
    const int count = static_cast<int>(graph.nodes.size());
    if (from < 0 || to < 0 || from >= count || to >= count) {
        return fail(Errc::kNotFound, "unknown_node", "The roadmap has no such node.");
    }
    if (from == to) return RoadPath{};
    RoadQuery query;
    query.goal = to;
    query.usable = usable;
    for (const int arc : graph.out[static_cast<std::size_t>(from)]) {
        const double heading = graph.arcs[static_cast<std::size_t>(arc)].heading_rad;
        query.first.push_back(
            {arc, 0, start_heading_rad && is_turn(cost, *start_heading_rad, heading), 0});
    }
    if (auto path = search_road(graph, cost, query)) return std::move(*path);
    return fail(Errc::kUnreachable, "no_route", "No route leads there. Check the roadmap's lanes.",
                {}, {{"from", std::int64_t{from}}, {"to", std::int64_t{to}}});
}

}  // namespace pulseline::planning
