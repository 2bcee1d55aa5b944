#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

FleetAnswer list_vehicles(FleetContext& context, const Request& request);
FleetAnswer get_vehicle(FleetContext& context, const Request& request);
FleetAnswer pause_vehicle(FleetContext& context, const Request& request);
FleetAnswer init_position(FleetContext& context, const Request& request);
FleetAnswer move_lifts(FleetContext& context, const Request& request);
FleetAnswer stop_lifts(FleetContext& context, const Request& request);
FleetAnswer integrate_vehicle(FleetContext& context, const Request& request);

FleetAnswer get_fleet(FleetContext& context, const Request& request);
FleetAnswer pause_fleet(FleetContext& context, const Request& request);
FleetAnswer resume_fleet(FleetContext& context, const Request& request);

FleetAnswer list_stations(FleetContext& context, const Request& request);
FleetAnswer get_station(FleetContext& context, const Request& request);

}  // namespace pulseline::api
