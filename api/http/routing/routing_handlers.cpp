#include "api/http/routing/routing_handlers.hpp"

#include "api/http/routing/routing_requests.hpp"
#include "api/http/wire/chain_json.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/problem.hpp"
#include "core/planning/grid/grid_cost.hpp"
#include "core/planning/legs/route_chain.hpp"
#include "core/planning/roads/what_if.hpp"

namespace pulseline::api {
namespace {

using planning::Bar;
using Difference = planning::RouteDifference;

double in_k(std::int64_t thousandths) {
    return static_cast<double>(thousandths) / planning::kCostUnit;
}

template <class Parts>
Json parts_json(const Parts& parts) {
    Json json = {
        {"length", in_k(parts.length)}, {"turns", in_k(parts.turns)}, {"speed", in_k(parts.speed)}};
    // No plant says yet what an uncertain position costs: one that is always 0 would promise it.
    // How uncertain it is on a route, its marker_chain says.
    if (parts.accuracy != 0) json["accuracy"] = in_k(parts.accuracy);
    return json;
}

Json leg_json(const planning::WhatIfLeg& leg) {
    Json json = {{"edge", leg.edge.str()},      {"from", leg.from.str()},
                 {"to", leg.to.str()},          {"length_m", leg.cost.length_m},
                 {"turn", leg.cost.turn},       {"backwards", leg.backwards},
                 {"cost", parts_json(leg.cost)}};
    if (leg.max_speed_mps > 0) json["max_speed_mps"] = leg.max_speed_mps;
    return json;
}

Json route_json(const plant::Plant& plant, const planning::WhatIf& question,
                const planning::WhatIfRoute& route) {
    Json json = {{"cost", in_k(route.cost)},
                 {"length_m", route.length_m},
                 {"turns", route.turns},
                 {"legs", list_json(route.legs, leg_json)}};
    if (const auto chain = planning::route_chain(plant, question, route)) {
        json["marker_chain"] = chain_json(*chain);
    }
    return json;
}

const char* text(Difference::Reason reason) {
    switch (reason) {
        case Difference::Reason::kLength:
            return "length";
        case Difference::Reason::kTurns:
            return "turns";
        case Difference::Reason::kSpeed:
            return "speed";
        case Difference::Reason::kAccuracy:
            return "accuracy";
    }
    return "length";
}

const char* text(Bar bar) {
    switch (bar) {
        case Bar::kNone:
            break;
        case Bar::kClosed:
            return "closed";
        case Bar::kClass:
            return "not_for_type";
        case Bar::kTooNarrow:
            return "footprint_too_large";
    }
    return "closed";
}

Json bar_json(const planning::WhatIf& question, const planning::WhatIfBar& bar) {
    Json json{{"edge", bar.edge.str()}, {"why", text(bar.bar)}};
    for (const std::size_t i : bar.closures) {
        const auto& closure = question.closures[i];
        const char* what = closure.to_loads_only ? "loads" : "closures";
        json[what].push_back({{"id", closure.id}, {"name", closure.name}});
    }
    return json;
}

Json answer_json(const plant::Plant& plant, const planning::WhatIf& question,
                 const planning::WhatIfAnswer& answer) {
    Json json = {{"alternatives", Json::array()}};
    const auto bars = [&](const std::vector<planning::WhatIfBar>& all) {
        return list_json(all, [&](const auto& bar) { return bar_json(question, bar); });
    };
    if (answer.routes.empty()) {
        json["reason"] = reason_json(
            {"no_route",
             {{"from", std::int64_t{question.from}}, {"to", std::int64_t{question.to}}}});
        json["blocking"] = bars(answer.blocking);
        return json;
    }
    json["route"] = route_json(plant, question, answer.routes.front());
    for (std::size_t i = 1; i < answer.routes.size(); ++i) {
        Json other = route_json(plant, question, answer.routes[i]);
        other["more"] = parts_json(answer.differences[i - 1]);
        other["main_reason"] = text(answer.differences[i - 1].main_reason());
        json["alternatives"].push_back(std::move(other));
    }
    if (!answer.shortcut_bars.empty()) {
        json["barred_shortcut"] = {{"cost", in_k(answer.shortcut_cost)},
                                   {"blocking", bars(answer.shortcut_bars)}};
    }
    return json;
}

}  // namespace

FleetAnswer find_routes(FleetContext& context, const Request& request) {
    auto question = read_what_if(request);
    if (!question) return {problem(400, question.error(), request)};
    question->closures = planning::closed_to(question->loaded, context.fleet.closed_floors());
    // The search takes its time, and not the fleet's.
    return {{},
            [question = std::move(*question), &plant = context.plant,
             &request](const PlanContext&) -> FleetAnswer {
                const auto answer = planning::what_if(plant, question);
                // The request is well formed; what it names is not there: 422, never 404.
                if (!answer) return {problem(422, answer.error(), request)};
                return {json_response(200, answer_json(plant, question, *answer))};
            }};
}

}  // namespace pulseline::api
