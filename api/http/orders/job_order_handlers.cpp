#include "api/http/orders/job_order_handlers.hpp"

#include "api/http/orders/job_order_json.hpp"
#include "api/http/orders/order_requests.hpp"
#include "api/http/orders/preview_json.hpp"
#include "api/http/wire/etag.hpp"
#include "api/http/wire/page.hpp"
#include "api/http/wire/problem.hpp"
#include "core/fleet/views/order_preview.hpp"

namespace pulseline::api {
namespace {

constexpr std::size_t kPlannedByTheFleet = 4;  // steps; more take longer than others may wait
constexpr int kStopsOfExpectation = 200;  // newest ones; older ones tell of another state of repair

Response job_order_response(int status, const plant::Plant& plant, const fleet::JobOrder& order) {
    Response response = json_response(status, job_order_json(plant, order));
    response.headers.emplace_back("ETag", etag_of(order.revision));
    return response;
}

Error unknown_job_order(const std::string& id) {
    return {Errc::kNotFound,
            {"unknown_job_order", {{"id", id.substr(0, 64)}}},
            "There is no job order of that id; GET /api/v1/job-orders lists them.",
            {}};
}

/// Vehicles whose stops tell what to expect: all of the type of the previewed one.
std::vector<plant::VehicleId> same_type(const plant::Plant& plant, const plant::VehicleId& id) {
    std::vector<plant::VehicleId> vehicles;
    const plant::Vehicle* wanted = plant::find_vehicle(plant, id);
    for (const plant::Vehicle& vehicle : plant.vehicles) {
        if (wanted != nullptr && vehicle.type == wanted->type) vehicles.push_back(vehicle.id);
    }
    return vehicles;
}

Response render_preview(const HistoryContext& context, const fleet::Preview& preview) {
    const auto vehicles = same_type(context.plant, preview.vehicle);
    std::vector<std::optional<fleet::StopStatistics>> expected(preview.steps.size());
    std::map<plant::MotionMode, fleet::StopStatistics> known;  // steps share modes: ask once
    for (std::size_t i = 0; i < preview.steps.size() && !vehicles.empty(); ++i) {
        const auto mode = preview.steps[i].chosen;
        if (!mode) continue;
        if (known.count(*mode) == 0) {
            known[*mode] = context.history.statistics(vehicles, *mode, kStopsOfExpectation);
        }
        expected[i] = known[*mode];
    }
    const Arrivals arrivals = arrivals_of(context.history, preview.vehicle);
    return json_response(200, preview_json(preview, expected, arrivals));
}

using Change = Result<fleet::JobOrder> (fleet::Fleet::*)(fleet::JobOrderId,
                                                         std::optional<std::int64_t>,
                                                         const std::string&, Time);

Response stale(const Request& request, std::int64_t revision) {
    Response refusal = problem(Error{Errc::kStale,
                                     {"stale_revision", {{"revision", revision}}},
                                     "The order has changed meanwhile; read it again, then decide.",
                                     "If-Match"},
                               request);
    refusal.headers.emplace_back("ETag", etag_of(revision));
    return refusal;
}

FleetAnswer change_job_order(FleetContext& context, const Request& request, Change change) {
    const auto id = fleet::JobOrderId::parse(request.param("id"));
    const auto present = id ? context.fleet.order(*id) : std::nullopt;
    if (!present) return {problem(unknown_job_order(request.param("id")), request)};
    if (!if_match_allows(request, etag_of(present->revision))) {
        return {stale(request, present->revision)};
    }
    const auto changed =
        (context.fleet.*change)(*id, present->revision, request.identity.name, context.now);
    if (!changed) return {problem(changed.error(), request)};
    return {job_order_response(202, context.plant, *changed)};
}

Result<Response> control(FleetContext& context, const Request& request,
                         const fleet::ControlRequest& wanted) {
    const auto id = fleet::JobOrderId::parse(request.param("id"));
    const auto present = id ? context.fleet.order(*id) : std::nullopt;
    if (!present) return problem(unknown_job_order(request.param("id")), request);
    // A repeated request carries the revision of its first time.
    const auto earlier = context.fleet.earlier_answer(wanted.idempotency_client,
                                                      wanted.idempotency_key, wanted.body_sha256);
    if (!earlier) return fail(earlier.error());
    if (!*earlier && !if_match_allows(request, etag_of(present->revision))) {
        return stale(request, present->revision);
    }
    const auto changed = context.fleet.control_order(*id, wanted, context.now);
    if (!changed) return fail(changed.error());
    return job_order_response(202, context.plant, changed->order);
}

/// 201 with the order and where it is, or why there is none.
Response created_answer(const FleetContext& context, const Request& request,
                        const Result<fleet::Created>& created) {
    if (!created) {
        // The order itself is there; what it names is not. That is 422, never 404.
        const Error& error = created.error();
        return error.code == Errc::kNotFound ? problem(422, error, request)
                                             : problem(error, request);
    }
    Response response = job_order_response(201, context.plant, created->order);
    response.headers.emplace_back("Location", "/api/v1/job-orders/" + created->order.id.str());
    return response;
}

}  // namespace

FleetAnswer create_job_order(FleetContext& context, const Request& request) {
    const auto dry_run = read_dry_run(request);
    if (!dry_run) return {problem(400, dry_run.error(), request)};
    const auto order = read_new_order(request);
    if (!order) return {problem(400, order.error(), request)};
    if (*dry_run) {
        return {{},
                [task = context.fleet.preview_task(*order, context.now)](
                    const PlanContext& with) -> FleetAnswer {
                    return {{},
                            nullptr,
                            [preview = with.orders.preview(task)](const HistoryContext& history) {
                                return render_preview(history, preview);
                            }};
                }};
    }
    return create_planned(context, request, *order, [](const Error& error) { return error; });
}

FleetAnswer create_planned(FleetContext& context, const Request& request,
                           const fleet::NewOrder& order, const InTheirTerms& told) {
    const auto create = [&request](FleetContext& with,
                                   const fleet::NewOrder& wanted) -> Result<Response> {
        const auto created = with.fleet.create(wanted, with.now);
        if (!created) return fail(created.error());
        return created_answer(with, request, created);
    };
    const auto refuse = [&request, told](const FleetContext& with, const Error& error) {
        return created_answer(with, request, fail(told(error)));
    };
    return planned_ahead(context, order, "", create, refuse);
}

FleetAnswer planned_ahead(FleetContext& context, const fleet::NewOrder& order,
                          const std::string& field, const Act& act, const Refuse& refuse,
                          fleet::JobOrderId self) {
    if (order.steps.size() <= kPlannedByTheFleet) {
        auto done = act(context, order);
        if (done) return {std::move(*done)};
        if (done.error().code != Errc::kNeedsPlan) return {refuse(context, done.error())};
    }
    FleetAnswer answer;
    answer.plan =
        [order, field, act, refuse,
         task = context.fleet.preview_task(order, context.now, self)](const PlanContext& with) {
            const Status plan = with.orders.plan_ahead(task);
            FleetAnswer planned;
            planned.again = [order, field, act, refuse, plan](FleetContext& then) -> FleetAnswer {
                fleet::NewOrder known = order;
                known.planned_beside = plan.has_value();
                auto done = act(then, known);
                if (done) return {std::move(*done)};
                // All but free manoeuvres the fleet judges itself, by what it knows now.
                if (done.error().code != Errc::kNeedsPlan || plan)
                    return {refuse(then, done.error())};
                Error error = plan.error();
                error.field = field + error.field;
                return {refuse(then, error)};
            };
            return planned;
        };
    return answer;
}

FleetAnswer control_job_order(FleetContext& context, const Request& request) {
    const auto wanted = read_job_control(request);
    if (!wanted) return {problem(400, wanted.error(), request)};
    const auto refuse = [&request](const FleetContext&, const Error& error) {
        return problem(error, request);
    };
    if (!wanted->update) {
        auto done = control(context, request, *wanted);
        return {done ? std::move(*done) : refuse(context, done.error())};
    }
    const auto update = [&request, wanted = *wanted](FleetContext& with,
                                                     const fleet::NewOrder& order) {
        fleet::ControlRequest changed = wanted;
        changed.update = order;
        return control(with, request, changed);
    };
    const auto self = fleet::JobOrderId::parse(request.param("id"));
    return planned_ahead(context, *wanted->update, "/order", update, refuse,
                         self.value_or(fleet::JobOrderId()));
}

FleetAnswer pause_job_order(FleetContext& context, const Request& request) {
    return change_job_order(context, request, &fleet::Fleet::pause_order);
}

FleetAnswer resume_job_order(FleetContext& context, const Request& request) {
    return change_job_order(context, request, &fleet::Fleet::resume_order);
}

FleetAnswer cancel_job_order(FleetContext& context, const Request& request) {
    return change_job_order(context, request, &fleet::Fleet::cancel_order);
}

Response list_job_orders(const HistoryContext& context, const Request& request) {
    auto query = read_order_query(request);
    if (!query) return problem(400, query.error(), request);
    const int limit = query->limit;
    query->limit = limit + 1;
    return json_response(
        200, page_json(context.history.orders(*query), limit, [&](const fleet::JobOrder& order) {
            return job_order_json(context.plant, order);
        }));
}

Response get_job_order(const HistoryContext& context, const Request& request) {
    const auto id = fleet::JobOrderId::parse(request.param("id"));
    const auto order = id ? context.history.order(*id) : std::nullopt;
    if (!order) return problem(unknown_job_order(request.param("id")), request);
    return job_order_response(200, context.plant, *order);
}

}  // namespace pulseline::api
