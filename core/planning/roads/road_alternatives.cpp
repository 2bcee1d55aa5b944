#include "core/planning/roads/road_alternatives.hpp"

#include <algorithm>
#include <queue>

namespace pulseline::planning {
namespace {

/// Least cost from the start to the end of every arc, and the arc before it, up to `most`.
struct Forwards {
    std::vector<RoadCost> cost;
    std::vector<std::int32_t> before;
};

bool is_set(const std::atomic<bool>* cancel) { return cancel && *cancel; }

Forwards search_forwards(const RoadView& view, const std::vector<RoadSeed>& seeds, RoadCost most,
                         const std::atomic<bool>* cancel) {
    const auto arcs = static_cast<std::size_t>(view.arcs());
    Forwards result{std::vector<RoadCost>(arcs, kNoWay), std::vector<std::int32_t>(arcs, -1)};
    using Open = std::pair<RoadCost, int>;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    const auto reach = [&](int arc, RoadCost from, RoadCost way, int before) {
        const auto i = static_cast<std::size_t>(arc);
        if (way == kNoWay || from + way > most || from + way >= result.cost[i]) return;
        result.cost[i] = from + way;
        result.before[i] = before;
        open.push({from + way, arc});
    };
    for (const RoadSeed& seed : seeds) {
        if (view.cost(seed.arc, false) != kNoWay) reach(seed.arc, 0, seed.cost, -1);
    }
    while (!open.empty() && !is_set(cancel)) {
        const auto [cost, arc] = open.top();
        open.pop();
        if (cost != result.cost[static_cast<std::size_t>(arc)]) continue;
        for (const RoadView::Link after : view.after(arc)) {
            reach(after.arc(), cost, view.cost(after.arc(), after.turn()), arc);
        }
    }
    return result;
}

/// The route over an arc; empty when it passes a node twice.
RoadRoute route_over(const RoadView& view, const CostTable& table, const Forwards& forwards,
                     std::optional<double> heading, int via, std::vector<char>& visited) {
    RoadRoute route;
    for (int at = via; at >= 0; at = forwards.before[static_cast<std::size_t>(at)]) {
        route.arcs.push_back(at);
    }
    std::reverse(route.arcs.begin(), route.arcs.end());
    for (int at = table.next(via); at >= 0; at = table.next(at)) route.arcs.push_back(at);
    bool simple = true;
    const auto start = static_cast<std::size_t>(view.arc(route.arcs.front()).from);
    visited[start] = 1;
    for (const int index : route.arcs) {
        const RoadArc& arc = view.arc(index);
        char& seen = visited[static_cast<std::size_t>(arc.to)];
        simple = simple && seen == 0;
        seen = 1;
        route.length_m += arc.length_m;
        route.turns +=
            heading && is_turn(view.preferences().cost, *heading, arc.heading_rad) ? 1 : 0;
        heading = arc.heading_rad;
    }
    visited[start] = 0;
    for (const int index : route.arcs) visited[static_cast<std::size_t>(view.arc(index).to)] = 0;
    if (!simple) route.arcs.clear();
    return route;
}

/// Lanes are the same when they join the same nodes: forwards or backwards is no other route.
double shared_m(const RoadView& view, const std::vector<int>& a, const std::vector<int>& b) {
    double sum = 0;
    for (const int index : a) {
        const RoadArc& arc = view.arc(index);
        const bool shared = std::any_of(b.begin(), b.end(), [&](int other) {
            return view.arc(other).from == arc.from && view.arc(other).to == arc.to;
        });
        if (shared) sum += arc.length_m;
    }
    return sum;
}

/// Adds to `chosen` until there are `count`.
void add_different(const RoadView& view, const CostTable& table, const std::vector<RoadSeed>& seeds,
                   std::optional<double> heading, RoadCost least, std::size_t count,
                   const AlternativesWanted& wanted, std::vector<RoadRoute>& chosen) {
    const double most = std::min(wanted.most_cost * least, double{kMostRoadCost} - 1);
    const Forwards forwards =
        search_forwards(view, seeds, static_cast<RoadCost>(most), wanted.cancel);
    std::vector<std::pair<RoadCost, int>> via;  // cost of the best route over an arc
    for (int arc = 0; arc < view.arcs(); ++arc) {
        const RoadCost before = forwards.cost[static_cast<std::size_t>(arc)];
        const RoadCost rest = table.left(arc);
        if (before == kNoWay || rest >= kMostRoadCost || before + rest > most) continue;
        via.push_back({before + rest, arc});
    }
    std::sort(via.begin(), via.end());
    std::vector<char> visited(view.graph().nodes.size(), 0);
    std::vector<RoadCost> examined(static_cast<std::size_t>(view.arcs()), kNoWay);
    for (const auto& [cost, arc] : via) {
        if (chosen.size() >= count || is_set(wanted.cancel)) break;
        // On a route of the same cost already looked at: most likely that very route.
        if (examined[static_cast<std::size_t>(arc)] == cost) continue;
        RoadRoute route = route_over(view, table, forwards, heading, arc, visited);
        for (const int on : route.arcs) examined[static_cast<std::size_t>(on)] = cost;
        if (route.arcs.empty()) continue;
        route.cost = cost;
        const bool differs = std::all_of(chosen.begin(), chosen.end(), [&](const RoadRoute& other) {
            return shared_m(view, route.arcs, other.arcs) <= wanted.most_shared * route.length_m;
        });
        if (differs) chosen.push_back(std::move(route));
    }
}

}  // namespace

std::vector<RoadRoute> alternatives(RoadRouter& router, int user, const RoadStart& start, int goal,
                                    const AlternativesWanted& wanted) {
    std::vector<RoadRoute> chosen(1);
    if (wanted.count < 1 || !router.find(user, start, goal, chosen.front())) return {};
    if (start.node == goal) return chosen;
    const RoadView& view = router.view(user);
    std::vector<RoadSeed> seeds;
    for (const int arc : view.graph().out[static_cast<std::size_t>(start.node)]) {
        const double heading = view.arc(arc).heading_rad;
        const bool turn =
            start.heading_rad && is_turn(view.preferences().cost, *start.heading_rad, heading);
        seeds.push_back({arc, view.cost(arc, turn)});
    }
    add_different(view, router.table(user, goal), seeds, start.heading_rad, chosen.front().cost,
                  static_cast<std::size_t>(wanted.count), wanted, chosen);
    return chosen;
}

std::vector<RoadRoute> other_routes(RoadRouter& router, int user,
                                    const std::vector<RoadSeed>& seeds, int goal,
                                    const RoadRoute& chosen, const AlternativesWanted& wanted) {
    const CostTable& table = router.table(user, goal);
    RoadCost least = kNoWay;
    for (const RoadSeed& seed : seeds) {
        const RoadCost rest = table.left(seed.arc);
        if (seed.cost < kMostRoadCost && rest < kMostRoadCost) {
            least = std::min(least, seed.cost + rest);
        }
    }
    if (least == kNoWay || wanted.count < 1) return {};
    std::vector<RoadRoute> routes{chosen};
    add_different(router.view(user), table, seeds, std::nullopt, least,
                  static_cast<std::size_t>(wanted.count) + 1, wanted, routes);
    routes.erase(routes.begin());
    return routes;
}

}  // namespace pulseline::planning
