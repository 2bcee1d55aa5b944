#include "api/plant/plant_codec.hpp"

#include "api/plant/decode_parts.hpp"

// Only what a field alone can get wrong is refused here (type, size, unknown name); what must hold
// between elements, and every physical limit, is core/plant/validate.
namespace pulseline::api::plant_file {

using namespace plant;

namespace {

using json::FieldErrors;
using namespace decoding;

constexpr json::IntegerLimits kNumber{0, 1'000'000};
constexpr CountLimits kMany{0, 100'000};
constexpr TextLimits kLoadName{1, 200};

template <class K>
std::vector<K> decode_keys(ObjectReader& in, const char* name) {
    std::vector<K> keys;
    in.items_if_any(name, kFew, [&](const Json& item, const std::string& at) {
        keys.push_back(K(json::read_text(item, at, in.errors(), kId)));
    });
    return keys;
}

Hall decode_hall(ObjectReader& in) {
    Hall hall;
    hall.id = decode_key<HallId>(in, "id");
    hall.name = in.text("name", kName);
    hall.names = decode_names(in);
    hall.outline = decode_ring(in, "outline");
    hall.occupancy_yaml = in.text_or("occupancy_yaml", "", {1, 255});
    return hall;
}

Tolerance decode_tolerance(ObjectReader in) {
    Tolerance t;
    t.shape = in.one_of_or("shape", t.shape, {Tolerance::Shape::kBox, Tolerance::Shape::kEllipse});
    t.dx_m = in.number("dx_m", kMetres);
    t.dy_m = in.number("dy_m", kMetres);
    t.dheading_rad = in.number("dheading_rad", kMetres);
    in.refuse_unknown();
    return t;
}

Station decode_station(ObjectReader& in) {
    Station station;
    station.id = decode_key<StationId>(in, "id");
    station.number = static_cast<int>(in.integer("number", kNumber));
    station.name = in.text("name", kName);
    station.names = decode_names(in);
    station.hall = decode_key<HallId>(in, "hall");
    station.pose = decode_pose(in.object("pose"));
    if (auto tolerance = in.object_if_any("tolerance")) {
        station.tolerance = decode_tolerance(*tolerance);
    }
    station.markers = decode_keys<MarkerId>(in, "markers");
    station.node = decode_key_or_none<NodeId>(in, "node");
    station.resting_place = in.boolean_or("resting_place", false);
    station.parks = in.boolean_or("parks", false);
    station.charger = in.boolean_or("charger", false);
    if (auto support = in.object_if_any("support")) {
        station.support = Support{support->number_or("height_m", Support{}.height_m, kMetres)};
        support->refuse_unknown();
    }
    station.vehicle_types = decode_keys<VehicleTypeId>(in, "vehicle_types");
    return station;
}

Marker decode_marker(ObjectReader& in) {
    Marker marker;
    marker.id = decode_key<MarkerId>(in, "id");
    marker.kind =
        in.one_of("kind", {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark});
    marker.payload = in.text("payload", kId);
    marker.size_m = in.number("size_m", kMetres);
    marker.hall = decode_key<HallId>(in, "hall");
    marker.pose = decode_pose(in.object("pose"));
    marker.sigma_xy_m = in.number_or("sigma_xy_m", marker.sigma_xy_m, kMetres);
    marker.sigma_heading_rad = in.number_or("sigma_heading_rad", marker.sigma_heading_rad, kMetres);
    return marker;
}

LightPlane decode_light_plane(ObjectReader in) {
    const LightPlane plane{in.number("a", kQuantity), in.number("b", kQuantity),
                           in.number_or("offset_m", 0, kMetres)};
    in.refuse_unknown();
    return plane;
}

Transmitter decode_transmitter(ObjectReader& in) {
    Transmitter t;
    t.id = decode_key<TransmitterId>(in, "id");
    t.hall = decode_key<HallId>(in, "hall");
    t.position = decode_point(in.object("position"));
    t.z_m = in.number("z_m", kMetres);
    t.roll_rad = wrap(in.number_or("roll_rad", t.roll_rad, kHeading));
    t.pitch_rad = wrap(in.number_or("pitch_rad", t.pitch_rad, kHeading));
    t.heading_rad = wrap(in.number("heading_rad", kHeading));
    t.rate_hz = in.number("rate_hz", kQuantity);
    if (auto plane = in.object_if_any("first")) t.first = decode_light_plane(*plane);
    if (auto plane = in.object_if_any("second")) t.second = decode_light_plane(*plane);
    t.range_m = in.number_or("range_m", t.range_m, kMetres);
    t.elevation_rad = in.number_or("elevation_rad", t.elevation_rad, kQuantity);
    t.sigma_rad = in.number_or("sigma_rad", t.sigma_rad, kQuantity);
    t.sigma_place_m = in.number_or("sigma_place_m", t.sigma_place_m, kMetres);
    t.sigma_turn_rad = in.number_or("sigma_turn_rad", t.sigma_turn_rad, kQuantity);
    return t;
}

Reflector decode_reflector(ObjectReader& in) {
    Reflector reflector;
    reflector.id = decode_key<ReflectorId>(in, "id");
    reflector.hall = decode_key<HallId>(in, "hall");
    reflector.position = decode_point(in.object("position"));
    reflector.sigma_m = in.number_or("sigma_m", reflector.sigma_m, kMetres);
    return reflector;
}

Area decode_area(ObjectReader& in) {
    Area area;
    area.id = decode_key<AreaId>(in, "id");
    area.kind =
        in.one_of("kind", {AreaKind::kZone, AreaKind::kLane, AreaKind::kNoGo, AreaKind::kObstacle});
    area.name = in.text("name", kName);
    area.names = decode_names(in);
    area.hall = decode_key<HallId>(in, "hall");
    area.outline = decode_ring(in, "outline");
    return area;
}

Vehicle decode_vehicle(ObjectReader& in) {
    Vehicle vehicle;
    vehicle.id = decode_key<VehicleId>(in, "id");
    vehicle.type = decode_key<VehicleTypeId>(in, "type");
    vehicle.manufacturer = in.text("manufacturer", kId);
    vehicle.serial_number = in.text("serial_number", kId);
    vehicle.name = in.text("name", kName);
    vehicle.home = decode_key<StationId>(in, "home");
    return vehicle;
}

Load decode_load(ObjectReader& in) {
    Load load;
    load.id = decode_key<LoadId>(in, "id");
    decode_load_sheet(in, load);
    load.vehicle = decode_key_or_none<VehicleId>(in, "vehicle");
    load.station = decode_key_or_none<StationId>(in, "station");
    return load;
}

RoadmapNode decode_node(ObjectReader& in) {
    RoadmapNode node;
    node.id = decode_key<NodeId>(in, "id");
    node.hall = decode_key<HallId>(in, "hall");
    node.position = decode_point(in.object("position"));
    return node;
}

RoadmapEdge decode_edge(ObjectReader& in) {
    RoadmapEdge edge;
    edge.id = decode_key<EdgeId>(in, "id");
    edge.from = decode_key<NodeId>(in, "from");
    edge.to = decode_key<NodeId>(in, "to");
    edge.max_speed_mps = in.number_or("max_speed_mps", 0, kQuantity);
    edge.vehicle_types = decode_keys<VehicleTypeId>(in, "vehicle_types");
    if (in.has("corridor")) {
        auto corridor = in.object("corridor");
        edge.corridor = {corridor.number("left_m", kMetres), corridor.number("right_m", kMetres)};
        corridor.refuse_unknown();
    }
    return edge;
}

RoutingCost decode_routing(ObjectReader in) {
    RoutingCost routing;
    routing.k_same = in.number("k_same", kQuantity);
    routing.k_diff = in.number("k_diff", kQuantity);
    routing.reference_step_m = in.number_or("reference_step_m", routing.reference_step_m, kMetres);
    routing.turn_threshold_rad =
        in.number_or("turn_threshold_rad", routing.turn_threshold_rad, kMetres);
    routing.accuracy_k = in.number_or("accuracy_k", routing.accuracy_k, kQuantity);
    in.refuse_unknown();
    return routing;
}

}  // namespace

void decode_load_sheet(ObjectReader& in, Load& load) {
    load.name = in.text_or("name", load.id.str(), kLoadName);
    load.names = decode_names(in);
    load.kind = in.one_of_or("kind", load.kind,
                             {LoadKind::kAirframe, LoadKind::kProduct, LoadKind::kInstrument});
    load.model = in.text_or("model", "", kName);
    load.mass_kg = in.number_or("mass_kg", 0, kQuantity);
    if (auto centre = in.object_if_any("centre")) load.centre = decode_point(*centre);
    if (in.has("outline")) load.outline = decode_ring(in, "outline");
    load.vehicle_types = decode_keys<VehicleTypeId>(in, "vehicle_types");
}

Plant decode_plant(const Json& json, FieldErrors& errors) {
    Plant plant;
    ObjectReader in(json, "", errors);
    in.find("$schema");  // editors like to find it
    plant.id = in.text("id", kId);
    plant.name = in.text("name", kName);
    plant.names = decode_names(in);
    plant.revision = in.integer_or("revision", 1, {1, 1'000'000'000});
    decode_all(in, "halls", kFew, plant.halls, decode_hall);
    decode_all(in, "stations", kMany, plant.stations, decode_station);
    decode_all(in, "markers", kMany, plant.markers, decode_marker);
    decode_all(in, "transmitters", kFew, plant.transmitters, decode_transmitter, false);
    decode_all(in, "reflectors", kFew, plant.reflectors, decode_reflector, false);
    decode_all(in, "areas", kMany, plant.areas, decode_area);
    decode_all(in, "vehicle_types", kFew, plant.vehicle_types, decode_vehicle_type);
    decode_all(in, "vehicles", kMany, plant.vehicles, decode_vehicle);
    decode_all(in, "loads", kMany, plant.loads, decode_load, false);
    ObjectReader roadmap = in.object("roadmap");
    decode_all(roadmap, "nodes", kMany, plant.nodes, decode_node);
    decode_all(roadmap, "edges", kMany, plant.edges, decode_edge);
    roadmap.refuse_unknown();
    if (auto routing = in.object_if_any("routing")) plant.routing = decode_routing(*routing);
    in.refuse_unknown();
    return plant;
}

}  // namespace pulseline::api::plant_file
