#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

FleetAnswer list_templates(FleetContext& context, const Request& request);
FleetAnswer create_template(FleetContext& context, const Request& request);
FleetAnswer get_template(FleetContext& context, const Request& request);
FleetAnswer delete_template(FleetContext& context, const Request& request);
FleetAnswer create_job_order_of_template(FleetContext& context, const Request& request);

}  // namespace pulseline::api
