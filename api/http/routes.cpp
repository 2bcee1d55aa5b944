#include "api/http/loads/load_handlers.hpp"
#include "api/http/orders/job_order_handlers.hpp"
#include "api/http/orders/schedule_handlers.hpp"
#include "api/http/orders/template_handlers.hpp"
#include "api/http/plant/marker_handlers.hpp"
#include "api/http/router.hpp"
#include "api/http/routing/routing_handlers.hpp"
#include "api/http/routing/traffic_handlers.hpp"
#include "api/http/session/service_handlers.hpp"
#include "api/http/session/session_handlers.hpp"
#include "api/http/stops/light_handlers.hpp"
#include "api/http/stops/localization_handlers.hpp"
#include "api/http/stops/stop_record_handlers.hpp"
#include "api/http/vehicles/camera_handlers.hpp"
#include "api/http/vehicles/motion_preview_handlers.hpp"
#include "api/http/vehicles/vehicle_handlers.hpp"

namespace pulseline::api {
namespace {

constexpr std::nullopt_t kPublic = std::nullopt;
constexpr auto kViewer = access::Role::kViewer;
constexpr auto kOperator = access::Role::kOperator;
constexpr std::size_t kImageBody = 8 * 1024 * 1024;  // two camera images as PNG, in base64

}  // namespace

// The names match openapi.yaml; a test holds the two together.
std::span<const Route> routes() {
    static const std::vector<Route> kRoutes = {
        // method, path, operation, least role, query parameters, handler
        {"GET", "/api/v1/session", "getSession", kViewer, {}, get_session},
        {"POST", "/api/v1/session", "signIn", kPublic, {}, sign_in, false, 0, false, true},
        {"DELETE", "/api/v1/session", "signOut", kViewer, {}, sign_out},

        {"GET", "/api/v1/plant", "getPlant", kViewer, {}, get_plant},
        {"GET", "/api/v1/halls/{hall}/grid", "getHallGrid", kViewer, {}, get_hall_grid},
        {"GET", "/api/v1/stations", "listStations", kViewer, {}, list_stations},
        {"GET", "/api/v1/stations/{number}", "getStation", kViewer, {}, get_station},

        {"GET",
         "/api/v1/marker-sheets",
         "printMarkers",
         kViewer,
         {"stations", "format"},
         print_markers,
         false,
         0,
         true},

        {"GET", "/api/v1/vehicles", "listVehicles", kViewer, {}, list_vehicles},
        {"GET", "/api/v1/vehicles/{id}", "getVehicle", kViewer, {}, get_vehicle},
        {"GET",
         "/api/v1/vehicles/{id}/cameras/{camera}",
         "getCameraImage",
         kViewer,
         {},
         get_camera_image},
        {"GET",
         "/api/v1/vehicles/{id}/cameras/{camera}/steps/{step}",
         "getCameraStep",
         kViewer,
         {},
         get_camera_step},
        {"POST", "/api/v1/vehicles/{id}/pause", "pauseVehicle", kOperator, {}, pause_vehicle},
        {"POST",
         "/api/v1/vehicles/{id}/init-position",
         "initPosition",
         kOperator,
         {},
         init_position},
        {"POST", "/api/v1/vehicles/{id}/lifts", "moveLifts", kOperator, {}, move_lifts},
        {"POST", "/api/v1/vehicles/{id}/lifts/stop", "stopLifts", kOperator, {}, stop_lifts},
        {"PUT",
         "/api/v1/vehicles/{id}/integration",
         "integrateVehicle",
         kOperator,
         {},
         integrate_vehicle},

        {"GET", "/api/v1/loads", "listLoads", kViewer, {}, list_loads},
        {"GET", "/api/v1/loads/{id}", "getLoad", kViewer, {}, get_load},
        {"GET",
         "/api/v1/loads/{id}/moves",
         "listLoadMoves",
         kViewer,
         {"limit", "cursor"},
         list_load_moves},
        {"PUT", "/api/v1/loads/{id}", "putLoad", kOperator, {}, put_load},
        {"DELETE", "/api/v1/loads/{id}", "retireLoad", kOperator, {}, retire_load},
        {"PUT", "/api/v1/loads/{id}/place", "placeLoad", kOperator, {}, place_load},

        {"GET", "/api/v1/fleet", "getFleet", kViewer, {}, get_fleet},
        {"POST", "/api/v1/fleet/pause", "pauseFleet", kOperator, {}, pause_fleet},
        {"POST", "/api/v1/fleet/resume", "resumeFleet", kOperator, {}, resume_fleet},

        {"GET",
         "/api/v1/job-orders",
         "listJobOrders",
         kViewer,
         {"state", "vehicle", "removed", "limit", "cursor"},
         list_job_orders},
        {"POST", "/api/v1/job-orders", "createJobOrder", kOperator, {"dryRun"}, create_job_order},
        {"GET", "/api/v1/job-orders/{id}", "getJobOrder", kViewer, {}, get_job_order},
        {"POST", "/api/v1/job-orders/{id}/pause", "pauseJobOrder", kOperator, {}, pause_job_order},
        {"POST",
         "/api/v1/job-orders/{id}/resume",
         "resumeJobOrder",
         kOperator,
         {},
         resume_job_order},
        {"POST",
         "/api/v1/job-orders/{id}/cancel",
         "cancelJobOrder",
         kOperator,
         {},
         cancel_job_order},

        {"GET", "/api/v1/traffic", "getTraffic", kViewer, {}, get_traffic},
        {"POST", "/api/v1/closures", "closeFloor", kOperator, {}, close_floor},
        {"DELETE", "/api/v1/closures/{id}", "reopenFloor", kOperator, {}, reopen_floor},

        {"POST",
         "/api/v1/job-orders/{id}/job-control",
         "controlJobOrder",
         kOperator,
         {},
         control_job_order},

        {"GET", "/api/v1/job-order-templates", "listTemplates", kViewer, {}, list_templates},
        {"POST", "/api/v1/job-order-templates", "createTemplate", kOperator, {}, create_template},
        {"GET", "/api/v1/job-order-templates/{name}", "getTemplate", kViewer, {}, get_template},
        {"DELETE",
         "/api/v1/job-order-templates/{name}",
         "deleteTemplate",
         kOperator,
         {},
         delete_template},
        {"POST",
         "/api/v1/job-order-templates/{name}/job-orders",
         "createJobOrderOfTemplate",
         kOperator,
         {},
         create_job_order_of_template},

        {"GET", "/api/v1/job-order-schedules", "listSchedules", kViewer, {}, list_schedules},
        {"POST", "/api/v1/job-order-schedules", "createSchedule", kOperator, {}, create_schedule},
        {"GET", "/api/v1/job-order-schedules/{id}", "getSchedule", kViewer, {}, get_schedule},
        {"DELETE",
         "/api/v1/job-order-schedules/{id}",
         "deleteSchedule",
         kOperator,
         {},
         delete_schedule},
        {"POST",
         "/api/v1/job-order-schedules/{id}/pause",
         "pauseSchedule",
         kOperator,
         {},
         pause_schedule},
        {"POST",
         "/api/v1/job-order-schedules/{id}/resume",
         "resumeSchedule",
         kOperator,
         {},
         resume_schedule},

        {"POST", "/api/v1/routes", "findRoutes", kOperator, {}, find_routes, true},
        {"POST", "/api/v1/motion-previews", "previewMotions", kOperator, {}, preview_motions, true},
        {"POST",
         "/api/v1/localizations",
         "localize",
         kOperator,
         {},
         localize,
         true,
         kImageBody,
         true},

        {"POST",
         "/api/v1/igps/measurements",
         "measureByLight",
         kOperator,
         {},
         measure_by_light,
         true},

        {"GET",
         "/api/v1/stop-records",
         "listStopRecords",
         kViewer,
         {"vehicle", "station", "order", "limit", "cursor"},
         list_stop_records},
        {"GET",
         "/api/v1/unmeasured-stops",
         "listUnmeasuredStops",
         kViewer,
         {"vehicle", "station", "order", "limit", "cursor"},
         list_unmeasured_stops},
        {"GET", "/api/v1/stop-records/{id}", "getStopRecord", kViewer, {}, get_stop_record},

        {"GET", "/api/v1/events", "streamEvents", kViewer, {"after"}, Socket::kEventStream},
        {"GET", "/api/v1/stream", "stream", kViewer, {}, Socket::kWebSocket},
        {"GET", "/api/v1/vehicles/{id}/hand-held", "handHeld", kOperator, {}, Socket::kHandHeld},

        {"GET", "/api/v1/openapi.json", "getOpenApi", kPublic, {}, get_openapi},
        {"GET", "/healthz", "health", kPublic, {}, health},
        {"GET", "/readyz", "ready", kPublic, {}, ready},
        {"GET", "/metrics", "metrics", kViewer, {}, metrics},
    };
    return kRoutes;
}

}  // namespace pulseline::api
