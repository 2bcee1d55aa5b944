#include "api/http/routing/traffic_handlers.hpp"

#include "api/http/routing/routing_requests.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {
namespace {

Json closure_json(const fleet::Closure& closure) {
    Json edges = Json::array();
    for (const auto& edge : closure.edges) edges.push_back(edge.str());
    Json json{{"id", closure.id.str()},
              {"name", closure.name},
              {"edges", std::move(edges)},
              {"created_by", closure.created_by},
              {"created_at", rfc3339(closure.created)}};
    if (!closure.outline.empty()) {
        json["hall"] = closure.hall.str();
        json["outline"] = ring_json(closure.outline);
    }
    return json;
}

Json wait_json(const fleet::TrafficView::Wait& wait) {
    Json json{{"vehicle", wait.vehicle.str()}, {"reason", reason_json(wait.reason)}};
    if (!wait.waits_for.empty()) json["waits_for"] = wait.waits_for.str();
    if (wait.until) json["until"] = rfc3339(*wait.until);
    return json;
}

}  // namespace

FleetAnswer get_traffic(FleetContext& context, const Request&) {
    const fleet::TrafficView view = context.fleet.traffic(context.now);
    Json json{{"waits", list_json(view.waits, wait_json)},
              {"closures", list_json(view.closures, closure_json)}};
    if (view.stopped) json["stopped"] = reason_json(*view.stopped);
    return {json_response(200, json)};
}

FleetAnswer close_floor(FleetContext& context, const Request& request) {
    const auto wanted = read_new_closure(request);
    if (!wanted) return {problem(400, wanted.error(), request)};
    const auto closed = context.fleet.close_floor(*wanted, request.identity.name, context.now);
    if (!closed) return {problem(closed.error(), request)};
    return {json_response(201, closure_json(*closed))};
}

FleetAnswer reopen_floor(FleetContext& context, const Request& request) {
    const auto id = fleet::ClosureId::parse(request.param("id"));
    const Status opened =
        id ? context.fleet.reopen_floor(*id, request.identity.name, context.now)
           : Status(fail(Errc::kNotFound, "unknown_closure",
                         "There is no closure of that id; GET /api/v1/traffic lists them."));
    if (!opened) return {problem(opened.error(), request)};
    return {Response{204, "", {}, {}}};
}

}  // namespace pulseline::api
