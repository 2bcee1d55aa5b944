#include "api/http/plant_json.hpp"

namespace pulseline::api {
namespace {

template <class Keys>
Json keys_json(const Keys& keys) {
    return list_json(keys, [](const auto& key) { return Json(key.str()); });
}

void put_names(Json& json, const plant::Names& names) {
    if (!names.empty()) json["names"] = names;
}

Json hall_json(const plant::Hall& hall) {
    Json json = {{"id", hall.id.str()}, {"name", hall.name}, {"outline", ring_json(hall.outline)}};
    put_names(json, hall.names);
    if (!hall.grid.empty()) {
        json["grid"] = {{"width", hall.grid.width},
                        {"height", hall.grid.height},
                        {"resolution_m", hall.grid.resolution_m},
                        {"origin", point_json(hall.grid.origin)}};
    }
    return json;
}

Json station_json(const plant::Station& station) {
    Json json = {{"id", station.id.str()},
                 {"number", station.number},
                 {"name", station.name},
                 {"hall", station.hall.str()},
                 {"pose", pose_json(station.pose)},
                 {"tolerance", tolerance_json(station.tolerance)},
                 {"markers", keys_json(station.markers)},
                 {"node", station.node.str()},
                 {"resting_place", station.resting_place},
                 {"charger", station.charger},
                 {"vehicle_types", keys_json(station.vehicle_types)}};
    put_names(json, station.names);
    return json;
}

Json marker_json(const plant::Marker& marker) {
    return {{"id", marker.id.str()},           {"kind", plant::to_string(marker.kind)},
            {"payload", marker.payload},       {"size_m", marker.size_m},
            {"hall", marker.hall.str()},       {"pose", pose_json(marker.pose)},
            {"sigma_xy_m", marker.sigma_xy_m}, {"sigma_heading_rad", marker.sigma_heading_rad}};
}

Json area_json(const plant::Area& area) {
    Json json = {{"id", area.id.str()},
                 {"kind", plant::to_string(area.kind)},
                 {"name", area.name},
                 {"hall", area.hall.str()},
                 {"outline", ring_json(area.outline)}};
    put_names(json, area.names);
    return json;
}

Json wheel_json(const plant::Wheel& wheel) {
    return {{"name", wheel.name},
            {"position", point_json(wheel.position)},
            {"driven", wheel.driven},
            {"steered", wheel.steered},
            {"diameter_m", wheel.diameter_m}};
}

Json mounting_json(const plant::CameraMounting& mounting) {
    return {{"body_from_camera", pose_json(mounting.body_from_camera)},
            {"height_m", mounting.height_m},
            {"tilt_u_rad", mounting.tilt_u_rad},
            {"tilt_v_rad", mounting.tilt_v_rad}};
}

Json camera_json(const plant::Camera& camera) {
    Json json = mounting_json(camera);
    json.update({{"name", camera.name},
                 {"f_px", camera.f_px},
                 {"width_px", camera.width_px},
                 {"height_px", camera.height_px},
                 {"cu_px", camera.cu_px},
                 {"cv_px", camera.cv_px},
                 {"k1", camera.k1}});
    if (camera.loaded) json["loaded"] = mounting_json(*camera.loaded);
    return json;
}

Json bracket_json(const plant::Bracket& bracket) {
    return {{"name", bracket.name}, {"position", point_json(bracket.position)}};
}

Json vehicle_type_json(const plant::VehicleType& type) {
    Json json = {
        {"id", type.id.str()},
        {"name", type.name},
        {"kinematics", plant::to_string(type.kinematics)},
        {"footprint", ring_json(type.footprint)},
        {"load_footprint", ring_json(type.load_footprint)},
        {"max_speed_mps", type.max_speed_mps},
        {"max_accel_mps2", type.max_accel_mps2},
        {"max_turn_rate_radps", type.max_turn_rate_radps},
        {"max_turn_accel_radps2", type.max_turn_accel_radps2},
        {"max_steering_rate_radps", type.max_steering_rate_radps},
        {"min_turn_radius_m", type.min_turn_radius_m},
        {"max_arc_radius_m", type.max_arc_radius_m},
        {"clearance_m", type.clearance_m},
        {"height_m", type.height_m},
        {"usual_code",
         {{"kind", plant::to_string(type.usual_code.kind)}, {"size_m", type.usual_code.size_m}}},
        {"motion_modes",
         list_json(type.motion_modes,
                   [](plant::MotionMode mode) { return Json(plant::to_string(mode)); })},
        {"wheels", list_json(type.wheels, wheel_json)},
        {"cameras", list_json(type.cameras, camera_json)},
        {"brackets", list_json(type.brackets, bracket_json)},
        {"mass_kg", type.mass_kg},
        {"max_load_kg", type.max_load_kg},
        {"battery",
         {{"critical_percent", type.battery.critical_percent},
          {"low_percent", type.battery.low_percent},
          {"enough_percent", type.battery.enough_percent}}}};
    put_names(json, type.names);
    return json;
}

Json plant_vehicle_json(const plant::Vehicle& vehicle) {
    return {{"id", vehicle.id.str()},
            {"type", vehicle.type.str()},
            {"manufacturer", vehicle.manufacturer},
            {"serial_number", vehicle.serial_number},
            {"name", vehicle.name},
            {"home", vehicle.home.str()},
            {"load_name", vehicle.load_name},
            {"load_kg", vehicle.load_kg}};
}

Json node_json(const plant::RoadmapNode& node) {
    return {
        {"id", node.id.str()}, {"hall", node.hall.str()}, {"position", point_json(node.position)}};
}

Json edge_json(const plant::RoadmapEdge& edge) {
    Json json = {{"id", edge.id.str()},
                 {"from", edge.from.str()},
                 {"to", edge.to.str()},
                 {"vehicle_types", keys_json(edge.vehicle_types)}};
    if (edge.max_speed_mps > 0) json["max_speed_mps"] = edge.max_speed_mps;
    if (edge.corridor) {
        json["corridor"] = {{"left_m", edge.corridor->left_m}, {"right_m", edge.corridor->right_m}};
    }
    return json;
}

}  // namespace

Json plant_json(const plant::Plant& plant) {
    Json json = {{"id", plant.id},
                 {"name", plant.name},
                 {"revision", plant.revision},
                 {"halls", list_json(plant.halls, hall_json)},
                 {"stations", list_json(plant.stations, station_json)},
                 {"markers", list_json(plant.markers, marker_json)},
                 {"areas", list_json(plant.areas, area_json)},
                 {"vehicle_types", list_json(plant.vehicle_types, vehicle_type_json)},
                 {"vehicles", list_json(plant.vehicles, plant_vehicle_json)},
                 {"roadmap",
                  {{"nodes", list_json(plant.nodes, node_json)},
                   {"edges", list_json(plant.edges, edge_json)}}},
                 {"routing",
                  {{"k_same", plant.routing.k_same},
                   {"k_diff", plant.routing.k_diff},
                   {"reference_step_m", plant.routing.reference_step_m},
                   {"turn_threshold_rad", plant.routing.turn_threshold_rad}}}};
    put_names(json, plant.names);
    return json;
}

Json station_state_json(const fleet::StationView& station) {
    Json json = {{"station", station.id.str()},
                 {"number", station.number},
                 {"occupied_by", station.occupied_by.str()},
                 {"reserved_by", station.reserved_by.str()},
                 {"ready", station.ready}};
    if (!station.last_stop.empty()) json["last_stop"] = station.last_stop.str();
    return json;
}

}  // namespace pulseline::api
