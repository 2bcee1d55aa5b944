#include "api/http/vehicles/vehicle_handlers.hpp"

#include "api/http/vehicles/unknown.hpp"
#include "api/http/vehicles/vehicle_json.hpp"
#include "api/http/vehicles/vehicle_requests.hpp"
#include "api/http/wire/etag.hpp"
#include "api/http/wire/page.hpp"
#include "api/http/wire/problem.hpp"
#include "api/http/wire/query.hpp"

namespace pulseline::api {
namespace {

Response fleet_response(int status, const FleetContext& context) {
    return json_response(status, fleet_json(context.plant, context.fleet.view(context.now)));
}

FleetAnswer vehicle_answer(const FleetContext& context, const Request& request,
                           const Result<fleet::VehicleView>& changed) {
    if (!changed) return {problem(changed.error(), request)};
    return {json_response(202, vehicle_json(context.plant, context.images, *changed))};
}

}  // namespace

FleetAnswer list_vehicles(FleetContext& context, const Request&) {
    auto vehicles = std::make_shared<const std::vector<fleet::VehicleView>>(
        context.fleet.vehicles(context.now));
    FleetAnswer answer;
    answer.encode = [vehicles = std::move(vehicles)](const EncodeContext& with) {
        const auto to_json = [&](const fleet::VehicleView& vehicle) {
            return vehicle_json(with.plant, with.images, vehicle);
        };
        return json_response(200, {{"items", list_json(*vehicles, to_json)}});
    };
    return answer;
}

FleetAnswer get_vehicle(FleetContext& context, const Request& request) {
    const auto vehicle = context.fleet.vehicle(plant::VehicleId(request.param("id")), context.now);
    if (!vehicle) return {problem(unknown_vehicle(request.param("id")), request)};
    Response response = json_response(200, vehicle_json(context.plant, context.images, *vehicle));
    response.headers.emplace_back("ETag", etag_of_content(response.body));
    return {std::move(response)};
}

FleetAnswer pause_vehicle(FleetContext& context, const Request& request) {
    return vehicle_answer(context, request,
                          context.fleet.pause_vehicle(plant::VehicleId(request.param("id")),
                                                      request.identity.name, context.now));
}

FleetAnswer init_position(FleetContext& context, const Request& request) {
    const auto stated = read_stated_pose(request);
    if (!stated) return {problem(400, stated.error(), request)};
    return vehicle_answer(context, request,
                          context.fleet.init_position(plant::VehicleId(request.param("id")),
                                                      *stated, request.identity.name, context.now));
}

FleetAnswer move_lifts(FleetContext& context, const Request& request) {
    const auto wanted = read_lift_move(request);
    if (!wanted) return {problem(400, wanted.error(), request)};
    return vehicle_answer(context, request,
                          context.fleet.move_lifts(plant::VehicleId(request.param("id")), *wanted,
                                                   request.identity.name, context.now));
}

FleetAnswer stop_lifts(FleetContext& context, const Request& request) {
    return vehicle_answer(context, request,
                          context.fleet.stop_lifts(plant::VehicleId(request.param("id")),
                                                   request.identity.name, context.now));
}

FleetAnswer integrate_vehicle(FleetContext& context, const Request& request) {
    const auto wanted = read_integration(request);
    if (!wanted) return {problem(400, wanted.error(), request)};
    return vehicle_answer(
        context, request,
        context.fleet.integrate(plant::VehicleId(request.param("id")), wanted->level,
                                wanted->off_floor, request.identity.name, context.now));
}

FleetAnswer get_fleet(FleetContext& context, const Request&) {
    return {fleet_response(200, context)};
}

FleetAnswer pause_fleet(FleetContext& context, const Request& request) {
    context.fleet.pause_fleet(request.identity.name, context.now);
    return {fleet_response(202, context)};
}

FleetAnswer resume_fleet(FleetContext& context, const Request& request) {
    const auto vehicles = read_resume_fleet(request);
    if (!vehicles) return {problem(400, vehicles.error(), request)};
    const Status resumed =
        context.fleet.resume_fleet(*vehicles, request.identity.name, context.now);
    if (!resumed) return {problem(resumed.error(), request)};
    return {fleet_response(202, context)};
}

FleetAnswer list_stations(FleetContext& context, const Request&) {
    FleetAnswer answer;
    answer.encode = [stations = context.fleet.stations()](const EncodeContext&) {
        return json_response(200, {{"items", list_json(stations, station_state_json)}});
    };
    return answer;
}

FleetAnswer get_station(FleetContext& context, const Request& request) {
    const auto number = parse_integer(request.param("number"), 0, kMaxStation);
    const auto station = number ? context.fleet.station(static_cast<int>(*number)) : std::nullopt;
    if (station) return {json_response(200, station_state_json(*station))};
    return {problem(unknown("unknown_station", request.param("number"),
                            "There is no station of that number; GET /api/v1/stations lists them."),
                    request)};
}

}  // namespace pulseline::api
