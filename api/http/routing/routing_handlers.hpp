#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

/// POST /api/v1/routes: routes over the roadmap as they would be, changing nothing. Runs on the
/// history thread, since it works the lanes out for the vehicle type.
FleetAnswer find_routes(FleetContext& context, const Request& request);

}  // namespace pulseline::api
