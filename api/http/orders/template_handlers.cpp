#include "api/http/orders/template_handlers.hpp"

#include "api/http/orders/job_order_handlers.hpp"
#include "api/http/orders/order_requests.hpp"
#include "api/http/orders/template_body.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {
namespace {

Response unknown_template(const Request& request) {
    return problem(Error{Errc::kNotFound,
                         {"unknown_template", {{"template", request.param("name").substr(0, 64)}}},
                         "There is no such template; GET /api/v1/job-order-templates lists them.",
                         {}},
                   request);
}

}  // namespace

FleetAnswer list_templates(FleetContext& context, const Request&) {
    return {
        json_response(200, {{"items", list_json(context.fleet.order_templates(), template_json)}})};
}

FleetAnswer create_template(FleetContext& context, const Request& request) {
    const auto wanted = read_template(request);
    if (!wanted) return {problem(400, wanted.error(), request)};
    const auto made = context.fleet.store_template(*wanted, context.now);
    if (!made) return {problem(made.error(), request)};
    return {json_response(201, template_json(*made))};
}

FleetAnswer get_template(FleetContext& context, const Request& request) {
    const auto found = context.fleet.order_template(request.param("name"));
    if (!found) return {unknown_template(request)};
    return {json_response(200, template_json(*found))};
}

FleetAnswer delete_template(FleetContext& context, const Request& request) {
    const auto gone =
        context.fleet.delete_template(request.param("name"), request.identity.name, context.now);
    if (!gone) return {unknown_template(request)};
    return {Response{204, "", {}, ""}};
}

FleetAnswer create_job_order_of_template(FleetContext& context, const Request& request) {
    const auto found = context.fleet.order_template(request.param("name"));
    if (!found) return {unknown_template(request)};
    auto instance = read_instance(*found, request);
    if (!instance) return {problem(400, instance.error(), request)};
    if (auto asker = read_asker_of_instance(request, instance->order); !asker) {
        return {problem(400, asker.error(), request)};
    }
    return create_planned(context, request, instance->order,
                          [instance = *instance](const Error& error) {
                              return in_terms_of_parameters(error, instance);
                          });
}

}  // namespace pulseline::api
