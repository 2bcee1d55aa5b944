#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

FleetAnswer list_loads(FleetContext& context, const Request& request);
FleetAnswer get_load(FleetContext& context, const Request& request);
Response list_load_moves(const HistoryContext& context, const Request& request);
FleetAnswer put_load(FleetContext& context, const Request& request);
FleetAnswer retire_load(FleetContext& context, const Request& request);
FleetAnswer place_load(FleetContext& context, const Request& request);

}  // namespace pulseline::api
