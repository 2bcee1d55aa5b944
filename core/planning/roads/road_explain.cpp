#include "core/planning/roads/road_explain.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

namespace pulseline::planning {
namespace {

/// Costs as if every lane were open to the user.
ArcCost open_cost(const RoadRouter& router, int user, int arc) {
    const RoadView& view = router.view(user);
    return arc_cost(view.preferences(), view.arc(arc), router.rules(arc), view.user());
}

/// Cheapest way over barred arcs too. `per_bar`: each of them counts before any cost does.
std::optional<RoadRoute> search_barred(const RoadRouter& router, int user, const RoadStart& start,
                                       int goal, bool per_bar) {
    const RoadView& view = router.view(user);
    struct Label {
        int bars = std::numeric_limits<int>::max();
        std::int64_t cost = 0;
        int before = -1;
    };
    std::vector<Label> labels(static_cast<std::size_t>(view.arcs()));
    using Open = std::tuple<int, std::int64_t, int>;  // bars, cost, arc
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    const auto reach = [&](int arc, bool turn, const Label& from, int before) {
        const ArcCost cost = open_cost(router, user, arc);
        const bool barred = bar_of(router.rules(arc), view.user()) != Bar::kNone;
        const Label label{from.bars + (barred && per_bar ? 1 : 0),
                          from.cost + (turn ? cost.turned() : cost.straight()), before};
        Label& known = labels[static_cast<std::size_t>(arc)];
        if (std::tie(label.bars, label.cost) >= std::tie(known.bars, known.cost)) return;
        known = label;
        open.push({label.bars, label.cost, arc});
    };
    const plant::RoutingCost& turns = view.preferences().cost;
    for (const int arc : router.graph().out[static_cast<std::size_t>(start.node)]) {
        const double heading = view.arc(arc).heading_rad;
        const bool turn = start.heading_rad && is_turn(turns, *start.heading_rad, heading);
        reach(arc, turn, {0, 0, -1}, -1);
    }
    while (!open.empty()) {
        const auto [bars, cost, arc] = open.top();
        open.pop();
        const Label label = labels[static_cast<std::size_t>(arc)];
        if (bars != label.bars || cost != label.cost) continue;
        if (view.arc(arc).to != goal) {
            for (const RoadView::Link after : view.after(arc)) {
                reach(after.arc(), after.turn(), label, arc);
            }
            continue;
        }
        RoadRoute route;
        route.cost = static_cast<RoadCost>(std::min<std::int64_t>(cost, kMostRoadCost));
        for (int at = arc; at >= 0; at = labels[static_cast<std::size_t>(at)].before) {
            route.arcs.push_back(at);
            route.length_m += view.arc(at).length_m;
        }
        std::reverse(route.arcs.begin(), route.arcs.end());
        std::optional<double> heading = start.heading_rad;
        for (const int at : route.arcs) {
            route.turns += heading && is_turn(turns, *heading, view.arc(at).heading_rad) ? 1 : 0;
            heading = view.arc(at).heading_rad;
        }
        return route;
    }
    return std::nullopt;
}

std::vector<BarredArc> bars_on(const RoadRouter& router, int user, const RoadRoute& route) {
    std::vector<BarredArc> bars;
    for (const int arc : route.arcs) {
        const Bar bar = bar_of(router.rules(arc), router.view(user).user());
        if (bar != Bar::kNone) bars.push_back({arc, bar});
    }
    return bars;
}

}  // namespace

std::vector<RouteLegCost> leg_costs(const RoadRouter& router, int user, const RoadStart& start,
                                    const std::vector<int>& arcs) {
    const RoadView& view = router.view(user);
    std::vector<RouteLegCost> legs;
    std::optional<double> heading = start.heading_rad;
    for (const int index : arcs) {
        const RoadArc& arc = view.arc(index);
        const ArcCost cost = open_cost(router, user, index);
        const bool turn = heading && is_turn(view.preferences().cost, *heading, arc.heading_rad);
        legs.push_back({index, arc.length_m, turn, cost.length, turn ? cost.turn : 0, cost.speed,
                        cost.accuracy});
        heading = arc.heading_rad;
    }
    return legs;
}

RouteDifference::Reason RouteDifference::main_reason() const {
    const std::pair<std::int64_t, Reason> parts[] = {{length, Reason::kLength},
                                                     {turns, Reason::kTurns},
                                                     {speed, Reason::kSpeed},
                                                     {accuracy, Reason::kAccuracy}};
    return std::max_element(std::begin(parts), std::end(parts),
                            [](const auto& a, const auto& b) { return a.first < b.first; })
        ->second;
}

RouteDifference difference(const std::vector<RouteLegCost>& chosen,
                           const std::vector<RouteLegCost>& other) {
    RouteDifference sum;
    const auto add = [&](const std::vector<RouteLegCost>& legs, std::int64_t sign) {
        for (const RouteLegCost& leg : legs) {
            sum.length += sign * leg.length;
            sum.turns += sign * leg.turns;
            sum.speed += sign * leg.speed;
            sum.accuracy += sign * leg.accuracy;
        }
    };
    add(other, 1);
    add(chosen, -1);
    return sum;
}

std::optional<BarredRoute> barred_shortcut(const RoadRouter& router, int user,
                                           const RoadStart& start, int goal, RoadCost cost) {
    if (start.node == goal) return std::nullopt;
    auto route = search_barred(router, user, start, goal, false);
    if (!route || route->cost >= cost) return std::nullopt;
    auto bars = bars_on(router, user, *route);
    return BarredRoute{std::move(*route), std::move(bars)};
}

std::optional<std::vector<BarredArc>> blocking_set(const RoadRouter& router, int user,
                                                   const RoadStart& start, int goal) {
    if (start.node == goal) return std::vector<BarredArc>{};
    const auto route = search_barred(router, user, start, goal, true);
    if (!route) return std::nullopt;
    return bars_on(router, user, *route);
}

}  // namespace pulseline::planning
