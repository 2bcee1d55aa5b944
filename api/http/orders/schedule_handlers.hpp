#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

FleetAnswer list_schedules(FleetContext& context, const Request& request);
FleetAnswer create_schedule(FleetContext& context, const Request& request);
FleetAnswer get_schedule(FleetContext& context, const Request& request);
FleetAnswer delete_schedule(FleetContext& context, const Request& request);
FleetAnswer pause_schedule(FleetContext& context, const Request& request);
FleetAnswer resume_schedule(FleetContext& context, const Request& request);

}  // namespace pulseline::api
