#pragma once

#include "api/http/wire/contexts.hpp"

/// Who waits for whom on the floor, and floor that people close.
namespace pulseline::api {

FleetAnswer get_traffic(FleetContext& context, const Request& request);
FleetAnswer close_floor(FleetContext& context, const Request& request);
FleetAnswer reopen_floor(FleetContext& context, const Request& request);

}  // namespace pulseline::api
