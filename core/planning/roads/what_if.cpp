#include "core/planning/roads/what_if.hpp"

#include <algorithm>
#include <cmath>

#include "core/planning/roads/road_alternatives.hpp"

namespace pulseline::planning {
namespace {

// Classes of users: who drives forwards only is content with less.
constexpr std::uint64_t kAnyWay = 1;
constexpr std::uint64_t kForwards = 2;

bool is_backwards(const RoadArc& arc) {
    return std::abs(wrap(arc.body_rad - arc.heading_rad)) > kPi / 2;
}

Result<const plant::Station*> station_of(const plant::Plant& plant, int number, const char* field) {
    if (const auto* station = plant::find_station(plant, number)) return station;
    return fail(Errc::kNotFound, "unknown_station",
                "There is no station " + std::to_string(number) + ". Choose one of the plant's.",
                field, {{"station", std::int64_t{number}}});
}

std::vector<LaneRules> rules_of(const RoadmapIndex& roads, const Passage& passage,
                                const std::vector<plant::EdgeId>& closed,
                                const std::vector<std::vector<std::size_t>>& closures) {
    std::vector<LaneRules> rules(roads.graph().arcs.size());
    for (std::size_t i = 0; i < rules.size(); ++i) {
        const plant::RoadmapEdge& edge = roads.edge_of_arc(static_cast<int>(i));
        rules[i].closed = !closures[i].empty() ||
                          std::find(closed.begin(), closed.end(), edge.id) != closed.end();
        rules[i].too_narrow = passage.arc_free[i] == 0;
        rules[i].classes = passage.arc_allowed[i] == 0           ? 0
                           : is_backwards(roads.graph().arcs[i]) ? kAnyWay
                                                                 : kAnyWay | kForwards;
        rules[i].max_speed_mps = edge.max_speed_mps;
        rules[i].sigma_m = passage.sigma_m(static_cast<int>(i));
    }
    return rules;
}

WhatIfRoute route_of(const RoadmapIndex& roads, const RoadRouter& router, int user,
                     const RoadStart& start, const RoadRoute& route) {
    WhatIfRoute result{route.cost, route.length_m, route.turns, {}};
    for (const RouteLegCost& cost : leg_costs(router, user, start, route.arcs)) {
        const RoadArc& arc = roads.graph().arcs[static_cast<std::size_t>(cost.arc)];
        result.legs.push_back({roads.edge_of_arc(cost.arc).id, roads.node(arc.from).id,
                               roads.node(arc.to).id, is_backwards(arc),
                               roads.edge_of_arc(cost.arc).max_speed_mps, cost});
    }
    return result;
}

std::vector<WhatIfBar> named(const RoadmapIndex& roads, const std::vector<BarredArc>& bars,
                             const std::vector<std::vector<std::size_t>>& closures) {
    std::vector<WhatIfBar> result;
    for (const BarredArc& barred : bars) {
        result.push_back({roads.edge_of_arc(barred.arc).id, barred.bar,
                          closures[static_cast<std::size_t>(barred.arc)]});
    }
    return result;
}

tl::unexpected<Error> cancelled() {
    return fail(Errc::kUnavailable, "cancelled", "The question was withdrawn.");
}

}  // namespace

Result<WhatIfAnswer> what_if(const plant::Plant& plant, const WhatIf& question) {
    if (const auto ok = check(plant.routing); !ok) return fail(ok.error());
    const auto* type = plant::find_vehicle_type(plant, question.vehicle_type);
    if (!type) {
        return fail(Errc::kNotFound, "unknown_vehicle_type",
                    "There is no such vehicle type. Choose one of the plant's.", "/vehicle_type",
                    {{"vehicle_type", question.vehicle_type.str()}});
    }
    const auto from = station_of(plant, question.from, "/from");
    if (!from) return fail(from.error());
    const auto to = station_of(plant, question.to, "/to");
    if (!to) return fail(to.error());
    if ((*from)->hall != (*to)->hall) {
        return fail(Errc::kUnreachable, "other_hall",
                    "The stations stand in different halls. Choose two of one hall.", "/to",
                    {{"from", (*from)->hall.str()}, {"to", (*to)->hall.str()}});
    }
    for (std::size_t i = 0; i < question.closed.size(); ++i) {
        const auto& id = question.closed[i];
        if (std::any_of(plant.edges.begin(), plant.edges.end(),
                        [&](const auto& edge) { return edge.id == id; })) {
            continue;
        }
        return fail(Errc::kNotFound, "unknown_edge", "There is no such lane to close.",
                    "/closed_edges/" + std::to_string(i), {{"edge", id.str()}});
    }
    const RoadmapIndex roads(plant);
    RoadStart start;
    start.node = roads.node((*from)->node);
    const int goal = roads.node((*to)->node);
    WhatIfAnswer answer;
    if (start.node < 0 || goal < 0) return answer;

    const Passage passage = roads.passage(*type, question.loaded);
    const auto closures = closures_over_arcs(
        roads, passage, question.present_closures ? question.closures : std::vector<ClosedFloor>{});
    RoadRouter router(roads.graph(), rules_of(roads, passage, question.closed, closures),
                      {plant.routing});
    const auto add_user = [&](std::uint64_t vehicle_class) {
        return router.add_user(
            {vehicle_class, question.loaded, type->max_speed_mps,
             [&](int arc, int next) { return roads.may_follow(passage, arc, next); }});
    };
    // Backwards costs the same, so it is offered only where it saves something.
    const int forwards = add_user(kForwards);
    const int any_way = add_user(kAnyWay);
    if (!router.prepare(any_way, goal, question.cancel) ||
        !router.prepare(forwards, goal, question.cancel)) {
        return cancelled();
    }
    const RoadCost least = router.cost(any_way, start, goal);
    const bool forwards_will_do = least != kNoWay && router.cost(forwards, start, goal) == least;
    const int user = forwards_will_do ? forwards : any_way;
    const auto routes = alternatives(
        router, user, start, goal, {.count = question.alternatives + 1, .cancel = question.cancel});
    if (question.cancel && *question.cancel) return cancelled();
    for (const RoadRoute& route : routes) {
        answer.routes.push_back(route_of(roads, router, user, start, route));
    }
    for (std::size_t i = 1; i < routes.size(); ++i) {
        answer.differences.push_back(difference(leg_costs(router, user, start, routes[0].arcs),
                                                leg_costs(router, user, start, routes[i].arcs)));
    }
    if (!routes.empty()) {
        if (const auto barred = barred_shortcut(router, any_way, start, goal, routes[0].cost)) {
            answer.shortcut_bars = named(roads, barred->bars, closures);
            answer.shortcut_cost = barred->route.cost;
        }
    } else if (const auto set = blocking_set(router, any_way, start, goal)) {
        answer.blocking = named(roads, *set, closures);
    }
    return answer;
}

}  // namespace pulseline::planning
