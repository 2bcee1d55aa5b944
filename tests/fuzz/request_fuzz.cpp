// The first line is the target of a request, the rest its body: read by every decoder of what a
// client may send, cursors, pages and the start of an event stream among them.
#include <string_view>

#include "api/http/orders/order_requests.hpp"
#include "api/http/orders/schedule_json.hpp"
#include "api/http/orders/template_body.hpp"
#include "api/http/plant/sheets_request.hpp"
#include "api/http/routing/routing_requests.hpp"
#include "api/http/session/sign_in_request.hpp"
#include "api/http/stops/stop_requests.hpp"
#include "api/http/vehicles/vehicle_requests.hpp"
#include "api/http/wire/body.hpp"
#include "api/http/wire/query.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace pulseline;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto end = std::min(bytes.find('\n'), bytes.size());
    api::Request request;
    request.method = "POST";
    const std::string_view target = bytes.substr(0, end);
    if (!api::parse_target(target, request)) return 0;
    request.body = bytes.substr(std::min(end + 1, bytes.size()));
    request.headers = {{"content-type", "application/json"},
                       {"idempotency-key", std::string(target.substr(0, 80))},
                       {"if-match", std::string(target.substr(0, 40))},
                       {"last-event-id", std::string(target.substr(0, 20))}};
    request.params = {{"id", request.path}, {"name", request.path}};
    (void)api::read_body(request);
    (void)api::read_sign_in(request);
    (void)api::read_new_order(request);
    (void)api::read_job_control(request);
    (void)api::read_new_schedule(request);
    (void)api::read_stated_pose(request);
    (void)api::read_integration(request);
    (void)api::read_resume_fleet(request);
    (void)api::read_new_closure(request);
    (void)api::read_what_if(request);
    (void)api::read_motion_question(request);
    (void)api::read_localization(request);
    (void)api::read_sheets(request);
    (void)api::read_dry_run(request);
    (void)api::read_order_query(request);
    (void)api::read_stop_query(request);
    (void)api::read_event_start(request);
    if (const auto one = api::read_template(request)) {
        (void)api::template_json(*one).dump();
        (void)api::read_instance(*one, request);
    }
    return 0;
}
