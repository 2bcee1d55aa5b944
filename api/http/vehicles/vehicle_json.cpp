#include "api/http/vehicles/vehicle_json.hpp"

#include <algorithm>

#include "api/http/wire/chain_json.hpp"

namespace pulseline::api {
namespace {

Json leg_json(const fleet::LegView& leg) {
    Json json = {{"id", leg.id.str()},
                 {"station", leg.station.str()},
                 {"mode", plant::to_string(leg.mode)},
                 {"path", ring_json(leg.path)},
                 {"granted_points", leg.granted_points},
                 {"granted_area", rings_json(leg.granted_area)},
                 {"horizon_area", rings_json(leg.horizon_area)},
                 {"duration_s", leg.duration_s},
                 {"progress", std::clamp(leg.progress, 0.0, 1.0)}};
    if (leg.started) json["started_at"] = rfc3339(*leg.started);
    if (leg.expected) json["expected_at"] = rfc3339(*leg.expected);
    if (leg.chain) json["marker_chain"] = chain_json(*leg.chain);
    return json;
}

Json error_json(const vda5050::VehicleError& error) {
    return {{"type", error.type}, {"fatal", error.fatal}, {"description", error.description}};
}

Json bracket_json(const vda5050::BracketStatus& bracket) {
    Json json{
        {"name", bracket.name}, {"force_a_n", bracket.force_a_n}, {"force_b_n", bracket.force_b_n}};
    if (bracket.height_m) json["height_m"] = *bracket.height_m;
    return json;
}

Json wheel_json(const plant::VehicleType* type, const vda5050::WheelStatus& wheel) {
    const auto limits = type == nullptr ? plant::DriveTemperatures{} : type->drive_temperatures;
    return {{"name", wheel.name},
            {"warm", wheel.temperature_c >= limits.warm_c},
            {"steering_rad", wheel.steering_rad},
            {"speed_mps", wheel.speed_mps},
            {"temperature_c", wheel.temperature_c},
            {"fault", wheel.fault}};
}

Json foot_json(const vda5050::ParkingFoot& foot) {
    Json json{{"name", foot.name}, {"extension_m", foot.extension_m}};
    if (foot.force_n) json["force_n"] = *foot.force_n;
    return json;
}

Json camera_json(const plant::VehicleType* type, const CameraImages& images,
                 const plant::VehicleId& vehicle, const vda5050::CameraReading& reading) {
    Json json = {{"name", reading.camera},         {"found", reading.found},
                 {"payload", reading.payload},     {"code", point_json(reading.code)},
                 {"angle_rad", reading.angle_rad}, {"sigma_m", reading.sigma_m},
                 {"rms_px", reading.rms_px},       {"why_not", reading.why_not}};
    if (reading.found && type != nullptr) {
        for (const plant::Camera& camera : type->cameras) {
            if (camera.name != reading.camera) continue;
            const auto off = reading.code - camera.body_from_camera.position();
            json["forward_m"] = off.x_m;
            json["left_m"] = off.y_m;
        }
    }
    if (const auto taken = images.taken(vehicle, reading.camera)) {
        json["image_at"] = rfc3339(*taken);
    }
    return json;
}

Json receiver_json(const vda5050::ReceiverReading& reading) {
    Json json = {{"name", reading.receiver},
                 {"found", reading.found},
                 {"transmitters", reading.transmitters}};
    if (reading.found) {
        json["place"] = point_json(reading.place);
        json["z_m"] = reading.z_m;
        json["sigma_m"] = reading.sigma_m;
    } else {
        json["why_not"] = reading.why_not;
    }
    return json;
}

Json navigation_json(const vda5050::NavigationStatus& status) {
    Json json = {{"by", status.by}, {"driven_m", status.driven_m}};
    if (status.explained >= 0) json["explained"] = status.explained;
    if (!status.why_not.empty()) json["why_not"] = status.why_not;
    return json;
}

/// `told_at`: when the vehicle told of it.
Json fix_json(const vda5050::PoseFixReport& fix, Time told_at) {
    Json json = {{"by", fix.by},           {"result", fix.result},
                 {"moved_m", fix.moved_m}, {"turned_rad", fix.turned_rad},
                 {"times", fix.times},     {"at", rfc3339(told_at - from_seconds(fix.ago_s))}};
    if (!fix.what.empty()) json["code"] = fix.what;
    if (!fix.why.empty()) json["why"] = fix.why;
    return json;
}

Json basis_json(const fleet::PoseBasis& basis) {
    Json json = {{"kind", fleet::to_string(basis.kind)},
                 {"at", rfc3339(basis.at)},
                 {"driven_m", basis.driven_m}};
    if (!basis.station.empty()) json["station"] = basis.station.str();
    if (!basis.actor.empty()) json["by"] = basis.actor;
    return json;
}

Json lift_json(const fleet::LiftMove& lift) {
    Json json = {{"type", lift.what.type},
                 {"state", fleet::to_string(lift.state)},
                 {"by", lift.actor},
                 {"at", rfc3339(lift.at)},
                 {"action_id", lift.action_id}};
    json.update(params_json(lift.what.params));
    if (!lift.why.empty()) json["why"] = lift.why;
    return json;
}

/// Of pauses from before they were kept, nobody may know who and when.
Json pause_json(const fleet::Pause& pause) {
    Json json = Json::object();
    if (!pause.actor.empty()) json["by"] = pause.actor;
    if (pause.at != Time{}) json["at"] = rfc3339(pause.at);
    return json;
}

}  // namespace

Json vehicle_json(const plant::Plant& plant, const CameraImages& images,
                  const fleet::VehicleView& vehicle) {
    const vda5050::StateMessage& state = vehicle.state;
    const plant::Vehicle* known = plant::find_vehicle(plant, vehicle.id);
    const plant::VehicleType* type =
        known != nullptr ? plant::find_vehicle_type(plant, known->type) : nullptr;
    const auto& load = vehicle.carries;
    Json json = {{"id", vehicle.id.str()},
                 {"name", known != nullptr ? known->name : vehicle.id.str()},
                 {"type", known != nullptr ? known->type.str() : ""},
                 {"link", fleet::to_string(vehicle.link)},
                 {"activity", fleet::to_string(vehicle.activity)},
                 {"pose_known", vehicle.pose_known},
                 {"hall", vehicle.hall},
                 {"at_station", vehicle.at_station.str()},
                 {"paused", vehicle.paused.has_value()},
                 {"pause_confirmed", state.paused},
                 {"needs_resume", vehicle.needs_resume},
                 {"integration", fleet::to_string(vehicle.integration)},
                 {"operating_mode", state.operating_mode},
                 {"battery_percent", state.battery_percent},
                 {"e_stop", state.e_stop},
                 {"field_violation", state.field_violation},
                 {"errors", list_json(state.errors, error_json)},
                 {"brackets", list_json(state.brackets, bracket_json)},
                 {"wheels", list_json(state.wheels,
                                      [&](const vda5050::WheelStatus& wheel) {
                                          return wheel_json(type, wheel);
                                      })},
                 {"cameras", list_json(state.cameras,
                                       [&](const vda5050::CameraReading& reading) {
                                           return camera_json(type, images, vehicle.id, reading);
                                       })},
                 {"parking_feet", list_json(state.parking_feet, foot_json)},
                 // Before its first state only the server knows what a vehicle carries.
                 {"load_kg", !vehicle.last_heard && load ? load->mass_kg : state.load_kg},
                 {"load_name", load ? load->name : ""}};
    if (state.in_hand_of) json["in_hand_of"] = *state.in_hand_of;
    if (load) json["load"] = load->id.str();
    if (const auto& worst = vehicle.load.worst) {
        json["worst_bracket"] = {
            {"bracket", worst->bracket}, {"share", worst->share}, {"limit", worst->limit}};
    }
    if (vehicle.load.centre) json["load_centre"] = point_json(*vehicle.load.centre);
    if (vehicle.load.fault) json["load_fault"] = reason_json(*vehicle.load.fault);
    if (vehicle.lift) json["lift"] = lift_json(*vehicle.lift);
    if (vehicle.reason) json["reason"] = reason_json(*vehicle.reason);
    if (vehicle.last_heard) {
        json["last_heard_at"] = rfc3339(*vehicle.last_heard);
        json["speed_mps"] = state.velocity_mps;
    }
    if (vehicle.pose) json["pose"] = pose_json(*vehicle.pose);
    if (vehicle.claimed_pose) json["claimed_pose"] = pose_json(*vehicle.claimed_pose);
    if (vehicle.pose_at) json["pose_at"] = rfc3339(*vehicle.pose_at);
    if (!vehicle.order.empty()) json["order"] = vehicle.order.str();
    if (vehicle.leg) json["leg"] = leg_json(*vehicle.leg);
    if (const auto& basis = vehicle.pose_basis) json["pose_basis"] = basis_json(*basis);
    if (!state.receivers.empty()) json["receivers"] = list_json(state.receivers, receiver_json);
    if (type != nullptr && type->navigation_scanner) {
        json["reflectors_in_view"] = state.reflectors.size();
    }
    if (vehicle.pose_known && !state.navigation.by.empty()) {
        json["navigation"] = navigation_json(state.navigation);
    }
    if (vehicle.pose_at && !state.fixes.empty()) {
        json["fixes"] = list_json(state.fixes, [&](const vda5050::PoseFixReport& fix) {
            return fix_json(fix, *vehicle.pose_at);
        });
    }
    if (const auto codes = fleet::codes_under_way(state); codes.passed > 0) {
        json["codes_under_way"] = {{"passed", codes.passed}, {"read", codes.read}};
        if (codes.read > 0) json["codes_under_way"]["last"] = codes.last;
    }
    if (state.deviation_range_m > 0) json["pose_deviation_m"] = state.deviation_range_m;
    if (!vehicle.made_way.empty()) {
        json["made_way"] = list_json(vehicle.made_way, [](Time at) { return Json(rfc3339(at)); });
    }
    if (vehicle.paused) {
        json["pause"] = pause_json(*vehicle.paused);
        json["pause"]["with_fleet"] = vehicle.paused->with_fleet;
        json["pause"]["stands"] = vehicle.stands_paused;
    }
    if (!vehicle.needs_resume_reason.code.empty()) {
        json["needs_resume_reason"] = reason_json(vehicle.needs_resume_reason);
    }
    return json;
}

Json fleet_json(const plant::Plant& plant, const fleet::FleetView& fleet) {
    Json json{
        {"paused", fleet.paused},
        {"last_event_seq", fleet.last_event_seq},
        {"vehicles_live", fleet.vehicles_live},
        {"vehicles_total", fleet.vehicles_total},
        {"needs_resume",
         list_json(fleet.needs_resume, [](const plant::VehicleId& id) { return Json(id.str()); })},
        {"plant_revision", plant.revision},
        {"server_started_at", rfc3339(fleet.started)}};
    if (fleet.pause) json["pause"] = pause_json(*fleet.pause);
    if (const auto& fault = fleet.store_fault) {
        json["read_only"] = {{"cause", fault->cause}, {"since", rfc3339(fault->since)}};
    }
    if (const auto& clock = fleet.clock_difference) {
        json["clock"] = {{"ahead_s", seconds(clock->ahead)}, {"since", rfc3339(clock->since)}};
    }
    return json;
}

Json station_state_json(const fleet::StationView& station) {
    Json json = {{"station", station.id.str()},
                 {"number", station.number},
                 {"occupied_by", station.occupied_by.str()},
                 {"reserved_by", station.reserved_by.str()},
                 {"ready", station.ready}};
    if (!station.last_stop.empty()) json["last_stop"] = station.last_stop.str();
    if (!station.holds.empty()) json["load"] = station.holds.str();
    return json;
}

}  // namespace pulseline::api
