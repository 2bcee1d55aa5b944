#pragma once

#include "api/http/contexts.hpp"

namespace pulseline::api {

/// POST /api/v1/routes: routes over the roadmap as they would be, changing nothing. Runs on the
/// history thread, since it works the lanes out for the vehicle type.
Response find_routes(const HistoryContext& context, const Request& request);

}  // namespace pulseline::api
