#include "api/http/session/service_handlers.hpp"

#include "api/http/wire/common_json.hpp"
#include "api/http/wire/etag.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {

Response get_plant(const InlineContext& context, const Request& request) {
    const Documents& documents = context.documents;
    Response response{200,
                      "application/json",
                      {{"ETag", documents.plant_etag}, {"Cache-Control", "private, no-cache"}},
                      {}};
    if (if_none_match_has(request, documents.plant_etag)) {
        response.status = 304;
    } else {
        response.body = documents.plant_json;
    }
    return response;
}

Response get_hall_grid(const InlineContext& context, const Request& request) {
    const auto& grids = context.documents.grid_png;
    const auto it = grids.find(request.param("hall"));
    if (it == grids.end()) {
        return problem(Error{Errc::kNotFound,
                             {"no_grid", {{"id", request.param("hall").substr(0, 64)}}},
                             "There is no hall of that id with an occupancy grid; the plant's "
                             "halls with one have `grid`.",
                             {}},
                       request);
    }
    return {200, "image/png", {{"Cache-Control", "private, no-cache"}}, it->second};
}

Response get_openapi(const InlineContext& context, const Request&) {
    return {
        200, "application/json", {{"Cache-Control", "no-cache"}}, context.documents.openapi_json};
}

Response health(const InlineContext& context, const Request&) {
    return json_response(200, {{"status", "ok"}, {"version", context.service.version()}});
}

Response ready(const InlineContext& context, const Request& request) {
    if (const auto why = context.service.not_ready()) return problem(503, *why, request);
    return json_response(200, {{"status", "ready"}, {"version", context.service.version()}});
}

Response metrics(const InlineContext& context, const Request&) {
    return {200,
            "text/plain; version=0.0.4; charset=utf-8",
            {{"Cache-Control", "no-store"}},
            context.service.metrics()};
}

}  // namespace pulseline::api
