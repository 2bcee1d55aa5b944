#include "api/http/orders/schedule_handlers.hpp"

#include "api/http/orders/job_order_handlers.hpp"
#include "api/http/orders/schedule_json.hpp"
#include "api/http/wire/etag.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {
namespace {

Response schedule_response(int status, const fleet::Schedule& schedule) {
    Response response = json_response(status, schedule_json(schedule));
    response.headers.emplace_back("ETag", etag_of(schedule.revision));
    return response;
}

Response unknown_schedule(const Request& request) {
    return problem(Error{Errc::kNotFound,
                         {"unknown_schedule", {{"schedule", request.param("id").substr(0, 64)}}},
                         "There is no such schedule; GET /api/v1/job-order-schedules lists them.",
                         {}},
                   request);
}

std::optional<fleet::Schedule> named(const FleetContext& context, const Request& request) {
    const auto id = fleet::ScheduleId::parse(request.param("id"));
    return id ? context.fleet.schedule(*id) : std::nullopt;
}

/// The present schedule, or the answer that refuses a change of it.
Result<fleet::Schedule> for_change(const FleetContext& context, const Request& request) {
    const auto present = named(context, request);
    if (!present) return fail(Errc::kNotFound, "unknown_schedule", "");
    if (if_match_allows(request, etag_of(present->revision))) return *present;
    return fail(Errc::kStale, "stale_revision",
                "The schedule has changed meanwhile; read it again, then decide.", "If-Match",
                {{"revision", present->revision}});
}

Response refusal(const Error& error, const Request& request) {
    return error.code == Errc::kNotFound ? unknown_schedule(request) : problem(error, request);
}

FleetAnswer set_paused(FleetContext& context, const Request& request, bool paused) {
    const auto present = for_change(context, request);
    if (!present) return {refusal(present.error(), request)};
    const auto changed = context.fleet.pause_schedule(present->id, paused, present->revision,
                                                      request.identity.name, context.now);
    if (!changed) return {refusal(changed.error(), request)};
    return {schedule_response(200, *changed)};
}

}  // namespace

FleetAnswer list_schedules(FleetContext& context, const Request&) {
    return {json_response(200, {{"items", list_json(context.fleet.schedules(), schedule_json)}})};
}

FleetAnswer create_schedule(FleetContext& context, const Request& request) {
    const auto wanted = read_new_schedule(request);
    if (!wanted) return {problem(400, wanted.error(), request)};
    const auto create = [wanted = *wanted](FleetContext& with,
                                           const fleet::NewOrder& order) -> Result<Response> {
        fleet::NewSchedule schedule = wanted;
        schedule.order = order;
        const auto made = with.fleet.create_schedule(schedule, with.now);
        if (!made) return fail(made.error());
        Response response = schedule_response(201, *made);
        response.headers.emplace_back("Location", "/api/v1/job-order-schedules/" + made->id.str());
        return response;
    };
    const auto refuse = [&request](const FleetContext&, const Error& error) {
        return problem(error, request);
    };
    return planned_ahead(context, wanted->order, "/order", create, refuse);
}

FleetAnswer get_schedule(FleetContext& context, const Request& request) {
    const auto found = named(context, request);
    return {found ? schedule_response(200, *found) : unknown_schedule(request)};
}

FleetAnswer delete_schedule(FleetContext& context, const Request& request) {
    const auto present = for_change(context, request);
    if (!present) return {refusal(present.error(), request)};
    const auto gone = context.fleet.delete_schedule(present->id, present->revision,
                                                    request.identity.name, context.now);
    if (!gone) return {refusal(gone.error(), request)};
    return {Response{204, "", {}, ""}};
}

FleetAnswer pause_schedule(FleetContext& context, const Request& request) {
    return set_paused(context, request, true);
}

FleetAnswer resume_schedule(FleetContext& context, const Request& request) {
    return set_paused(context, request, false);
}

}  // namespace pulseline::api
