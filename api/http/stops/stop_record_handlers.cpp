#include "api/http/stops/stop_record_handlers.hpp"

#include "api/http/orders/job_order_json.hpp"
#include "api/http/stops/stop_requests.hpp"
#include "api/http/wire/page.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {

Response list_stop_records(const HistoryContext& context, const Request& request) {
    auto query = read_stop_query(request);
    if (!query) return problem(400, query.error(), request);
    const int limit = query->limit;
    query->limit = limit + 1;
    return json_response(200, page_json(context.history.stops(*query), limit, stop_record_json));
}

Response list_unmeasured_stops(const HistoryContext& context, const Request& request) {
    auto query = read_unmeasured_query(request);
    if (!query) return problem(400, query.error(), request);
    const auto limit = static_cast<std::size_t>(query->limit);
    ++query->limit;
    auto events = context.history.unmeasured_stops(*query);
    Json page = Json::object();
    if (events.size() > limit) {
        events.resize(limit);
        page["next_cursor"] = std::to_string(events.back().seq);
    }
    page["items"] = list_json(events, event_json);
    return json_response(200, page);
}

Response get_stop_record(const HistoryContext& context, const Request& request) {
    const auto id = fleet::StopRecordId::parse(request.param("id"));
    const auto stop = id ? context.history.stop(*id) : std::nullopt;
    if (!stop) {
        return problem(
            Error{Errc::kNotFound,
                  {"unknown_stop_record", {{"id", request.param("id").substr(0, 64)}}},
                  "There is no stop record of that id; GET /api/v1/stop-records lists them.",
                  {}},
            request);
    }
    return json_response(200, stop_record_json(*stop));
}

}  // namespace pulseline::api
