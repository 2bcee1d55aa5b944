#include "db/plant/plant_rows.hpp"

#include "db/json_text.hpp"
#include "db/names.hpp"
#include "db/plant/plant_json.hpp"

namespace pulseline::db {
namespace {

// What the migration that brought feet wrote for the types that it found.
constexpr const char* kBeforeParking = "before";

template <class K>
std::string keys_to_json(const std::vector<K>& keys) {
    std::vector<std::string> texts;
    for (const K& key : keys) texts.push_back(key.str());
    return texts_to_json(texts);
}

template <class K>
std::vector<K> keys_from_json(const std::string& text) {
    std::vector<K> keys;
    for (const std::string& key : texts_from_json(text)) keys.push_back(K(key));
    return keys;
}

}  // namespace

void HallRow::set(const plant::Hall& hall) {
    element.name = hall.name;
    element.occupancy_yaml = hall.occupancy_yaml;
    element.grid.width = hall.grid.width;
    element.grid.height = hall.grid.height;
    element.grid.resolution_m = hall.grid.resolution_m;
    element.grid.origin = hall.grid.origin;
    id = hall.id.str();
    outline = polygon_to_json(hall.outline);
    names = names_to_json(hall.names);
}

plant::Hall HallRow::get() const {
    plant::Hall hall = element;
    hall.id = plant::HallId(id);
    hall.outline = polygon_from_json(outline);
    hall.names = names_from_json(names);
    return hall;
}

void NodeRow::set(const plant::RoadmapNode& node) {
    element = node;
    id = node.id.str();
    hall = node.hall.str();
}

plant::RoadmapNode NodeRow::get() const {
    return {plant::NodeId(id), plant::HallId(hall), element.position};
}

void EdgeRow::set(const plant::RoadmapEdge& edge) {
    id = edge.id.str();
    from = edge.from.str();
    to = edge.to.str();
    max_speed_mps = edge.max_speed_mps;
    vehicle_types = keys_to_json(edge.vehicle_types);
    corridor = edge.corridor.value_or(plant::Corridor{});
}

plant::RoadmapEdge EdgeRow::get() const {
    plant::RoadmapEdge edge{plant::EdgeId(id), plant::NodeId(from), plant::NodeId(to),
                            max_speed_mps, keys_from_json<plant::VehicleTypeId>(vehicle_types)};
    if (corridor != plant::Corridor{}) edge.corridor = corridor;
    return edge;
}

void VehicleTypeRow::set(const plant::VehicleType& type) {
    element = type;
    id = type.id.str();
    kinematics = plant::to_string(type.kinematics);
    footprint = polygon_to_json(type.footprint);
    load_footprint = polygon_to_json(type.load_footprint);
    std::vector<std::string> modes;
    for (const plant::MotionMode mode : type.motion_modes)
        modes.emplace_back(plant::to_string(mode));
    motion_modes = texts_to_json(modes);
    wheels = wheels_to_json(type.wheels);
    cameras = cameras_to_json(type.cameras);
    receivers = receivers_to_json(type.receivers);
    scanners = scanners_to_json(type.scanners);
    navigation_scanner = scanner_to_json(type.navigation_scanner);
    brackets = brackets_to_json(type.brackets);
    parking = parking_to_json(type.parking);
    load_rules = load_rules_to_json(type.load_rules);
    bracket_lift = bracket_lift_to_json(type.bracket_lift);
    casters = casters_to_json(type.casters);
    control = control_to_json(type.control);
    usual_code_kind = plant::to_string(type.usual_code.kind);
    slip_sensor_noise_mps = type.slip_sensor ? type.slip_sensor->noise_mps : 0;
    names = names_to_json(type.names);
}

plant::VehicleType VehicleTypeRow::get() const {
    plant::VehicleType type = element;
    type.id = plant::VehicleTypeId(id);
    read(kinematics, type.kinematics);
    type.footprint = polygon_from_json(footprint);
    type.load_footprint = polygon_from_json(load_footprint);
    type.motion_modes.clear();
    for (const std::string& name : texts_from_json(motion_modes)) {
        type.motion_modes.emplace_back();
        read(name, type.motion_modes.back());
    }
    type.wheels = wheels_from_json(wheels);
    type.cameras = cameras_from_json(cameras);
    type.receivers = receivers_from_json(receivers);
    // Of types that were stored before scanners were.
    type.scanners =
        scanners == "null" ? plant::usual_scanners(type.footprint) : scanners_from_json(scanners);
    type.navigation_scanner = scanner_from_json(navigation_scanner);
    type.brackets = brackets_from_json(brackets);
    // Before feet were stored, all types with brackets stood on such.
    type.parking = parking == kBeforeParking && !type.brackets.empty()
                       ? plant::usual_parking(type.footprint)
                       : parking_from_json(parking == kBeforeParking ? "null" : parking);
    type.load_rules = load_rules_from_json(load_rules);
    type.bracket_lift = bracket_lift_from_json(bracket_lift);
    type.casters = casters_from_json(casters);
    type.control = control_from_json(control);
    read(usual_code_kind, type.usual_code.kind);
    type.slip_sensor.reset();
    if (slip_sensor_noise_mps > 0) type.slip_sensor = {slip_sensor_noise_mps};
    type.names = names_from_json(names);
    return type;
}

void MarkerRow::set(const plant::Marker& marker) {
    element = marker;
    id = marker.id.str();
    kind = plant::to_string(marker.kind);
    hall = marker.hall.str();
}

plant::Marker MarkerRow::get() const {
    plant::Marker marker = element;
    marker.id = plant::MarkerId(id);
    read(kind, marker.kind);
    marker.hall = plant::HallId(hall);
    return marker;
}

void TransmitterRow::set(const plant::Transmitter& transmitter) {
    element = transmitter;
    id = transmitter.id.str();
    hall = transmitter.hall.str();
}

plant::Transmitter TransmitterRow::get() const {
    plant::Transmitter transmitter = element;
    transmitter.id = plant::TransmitterId(id);
    transmitter.hall = plant::HallId(hall);
    return transmitter;
}

void ReflectorRow::set(const plant::Reflector& reflector) {
    element = reflector;
    id = reflector.id.str();
    hall = reflector.hall.str();
}

plant::Reflector ReflectorRow::get() const {
    plant::Reflector reflector = element;
    reflector.id = plant::ReflectorId(id);
    reflector.hall = plant::HallId(hall);
    return reflector;
}

void AreaRow::set(const plant::Area& area) {
    id = area.id.str();
    kind = plant::to_string(area.kind);
    name = area.name;
    hall = area.hall.str();
    outline = polygon_to_json(area.outline);
    names = names_to_json(area.names);
}

plant::Area AreaRow::get() const {
    plant::Area area;
    area.id = plant::AreaId(id);
    read(kind, area.kind);
    area.name = name;
    area.hall = plant::HallId(hall);
    area.outline = polygon_from_json(outline);
    area.names = names_from_json(names);
    return area;
}

void StationRow::set(const plant::Station& station) {
    element = station;
    id = station.id.str();
    hall = station.hall.str();
    tolerance_shape = stored(station.tolerance.shape);
    markers = keys_to_json(station.markers);
    node = station.node.str();
    resting_place = station.resting_place;
    charger = station.charger;
    parks = station.parks;
    vehicle_types = keys_to_json(station.vehicle_types);
    names = names_to_json(station.names);
    has_support = station.support.has_value();
    support_height_m = station.support ? station.support->height_m : 0;
}

plant::Station StationRow::get() const {
    plant::Station station = element;
    station.id = plant::StationId(id);
    station.hall = plant::HallId(hall);
    read(tolerance_shape, station.tolerance.shape);
    station.markers = keys_from_json<plant::MarkerId>(markers);
    station.node = plant::NodeId(node);
    station.resting_place = resting_place != 0;
    station.charger = charger != 0;
    station.parks = parks != 0;
    station.vehicle_types = keys_from_json<plant::VehicleTypeId>(vehicle_types);
    station.names = names_from_json(names);
    if (has_support != 0) station.support = plant::Support{support_height_m};
    return station;
}

void PlantVehicleRow::set(const plant::Vehicle& vehicle) {
    element = vehicle;
    id = vehicle.id.str();
    type = vehicle.type.str();
    home = vehicle.home.str();
}

plant::Vehicle PlantVehicleRow::get() const {
    plant::Vehicle vehicle = element;
    vehicle.id = plant::VehicleId(id);
    vehicle.type = plant::VehicleTypeId(type);
    vehicle.home = plant::StationId(home);
    return vehicle;
}

void LoadRow::set(const plant::Load& load) {
    element = load;
    id = load.id.str();
    kind = plant::to_string(load.kind);
    outline = polygon_to_json(load.outline);
    vehicle_types = keys_to_json(load.vehicle_types);
    vehicle = load.vehicle.str();
    station = load.station.str();
    names = names_to_json(load.names);
}

plant::Load LoadRow::get() const {
    plant::Load load = element;
    load.id = plant::LoadId(id);
    read(kind, load.kind);
    load.outline = polygon_from_json(outline);
    load.vehicle_types = keys_from_json<plant::VehicleTypeId>(vehicle_types);
    load.vehicle = plant::VehicleId(vehicle);
    load.station = plant::StationId(station);
    load.names = names_from_json(names);
    return load;
}

}  // namespace pulseline::db
