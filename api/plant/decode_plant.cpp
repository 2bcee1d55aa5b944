#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "api/plant/plant_codec.hpp"

// Only what a field alone can get wrong is refused here (type, size, unknown name); what must hold
// between elements, and every physical limit, is core/plant/validate.
namespace pulseline::api::plant_file {

using namespace plant;

namespace {

using json::CountLimits;
using json::FieldErrors;
using json::Json;
using json::ObjectReader;
using json::TextLimits;

constexpr TextLimits kId{1, 64};
constexpr TextLimits kName{0, 200};
constexpr json::NumberLimits kMetres{-1e6, 1e6};
constexpr json::NumberLimits kHeading{-6.2832, 6.2832};
constexpr json::NumberLimits kQuantity{-1e9, 1e9};
constexpr json::NumberLimits kTilt{-0.5, 0.5};  // radians
constexpr json::NumberLimits kPercent{0, 100};
constexpr json::IntegerLimits kNumber{0, 1'000'000};
constexpr json::IntegerLimits kPixels{0, 100'000};
constexpr CountLimits kRingPoints{0, 1000};
constexpr CountLimits kMany{0, 100'000};
constexpr CountLimits kFew{0, 1000};

Point2 decode_point(ObjectReader in) {
    const Point2 point{in.number("x_m", kMetres), in.number("y_m", kMetres)};
    in.refuse_unknown();
    return point;
}

Pose2 decode_pose(ObjectReader in) {
    const Pose2 pose{in.number("x_m", kMetres), in.number("y_m", kMetres),
                     wrap(in.number("heading_rad", kHeading))};
    in.refuse_unknown();
    return pose;
}

Polygon decode_ring(ObjectReader& in, const char* name, bool required = true) {
    Polygon polygon;
    const auto add = [&](const Json& item, const std::string& at) {
        polygon.push_back(decode_point({item, at, in.errors()}));
    };
    if (required) {
        in.items(name, kRingPoints, add);
    } else {
        in.items_if_any(name, kRingPoints, add);
    }
    return polygon;
}

template <class K>
K decode_key(ObjectReader& in, const char* name) {
    return K(in.text(name, kId));
}

template <class K>
std::vector<K> decode_keys(ObjectReader& in, const char* name) {
    std::vector<K> keys;
    in.items_if_any(name, kFew, [&](const Json& item, const std::string& at) {
        keys.push_back(K(json::read_text(item, at, in.errors(), kId)));
    });
    return keys;
}

template <class T, class Decode>
void decode_all(ObjectReader& in, const char* name, CountLimits limits, std::vector<T>& to,
                Decode decode) {
    in.items(name, limits, [&](const Json& item, const std::string& at) {
        ObjectReader element(item, at, in.errors());
        to.push_back(decode(element));
        element.refuse_unknown();
    });
}

/// A language tag as BCP 47 begins them: "zh", "pt-BR".
bool is_language(std::string_view tag) {
    const auto end = std::ranges::find(tag, '-');
    const auto letters = end - tag.begin();
    const auto is_lower = [](char c) { return 'a' <= c && c <= 'z'; };
    const auto is_part = [&](char c) {
        return is_lower(c) || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '-';
    };
    return (letters == 2 || letters == 3) && tag.size() <= 35 && tag.back() != '-' &&
           std::all_of(tag.begin(), end, is_lower) && std::all_of(end, tag.end(), is_part);
}

/// {"zh": "..."}: what it is called in other languages.
Names decode_names(ObjectReader& in) {
    static constexpr std::size_t kLanguages = 16;
    Names names;
    const Json* object = in.find("names");
    if (object == nullptr) return names;
    const std::string pointer = json::child_pointer(in.pointer(), std::string_view("names"));
    if (!object->is_object() || object->size() > kLanguages) {
        in.errors().add(pointer, {"wrong_type", {{"expected", std::string("object")}}},
                        "Expected an object of at most 16 names by language here.");
        return names;
    }
    for (const auto& [language, name] : object->items()) {
        const std::string at = json::child_pointer(pointer, std::string_view(language));
        if (!is_language(language)) {
            in.errors().add(at, {"not_a_language", {}},
                            "Name a language by its tag, such as zh or pt-BR.");
            continue;
        }
        names[language] = json::read_text(name, at, in.errors(), kName);
    }
    return names;
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
    station.node = decode_key<NodeId>(in, "node");
    station.resting_place = in.boolean_or("resting_place", false);
    station.charger = in.boolean_or("charger", false);
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

Wheel decode_wheel(ObjectReader& in) {
    Wheel wheel;
    wheel.name = in.text("name", kName);
    wheel.position = decode_point(in.object("position"));
    wheel.driven = in.boolean("driven");
    wheel.steered = in.boolean("steered");
    wheel.diameter_m = in.number("diameter_m", kMetres);
    return wheel;
}

CameraMounting decode_mounting(ObjectReader& in) {
    return {decode_pose(in.object("body_from_camera")), in.number("height_m", kMetres),
            in.number_or("tilt_u_rad", 0, kTilt), in.number_or("tilt_v_rad", 0, kTilt)};
}

Camera decode_camera(ObjectReader& in) {
    Camera camera;
    static_cast<CameraMounting&>(camera) = decode_mounting(in);
    camera.name = in.text("name", kId);
    camera.f_px = in.number("f_px", kQuantity);
    camera.width_px = static_cast<int>(in.integer("width_px", kPixels));
    camera.height_px = static_cast<int>(in.integer("height_px", kPixels));
    camera.cu_px = in.number("cu_px", kQuantity);
    camera.cv_px = in.number("cv_px", kQuantity);
    camera.k1 = in.number_or("k1", 0, kQuantity);
    if (auto loaded = in.object_if_any("loaded")) {
        camera.loaded = decode_mounting(*loaded);
        loaded->refuse_unknown();
    }
    return camera;
}

Bracket decode_bracket(ObjectReader& in) {
    Bracket bracket;
    bracket.name = in.text("name", kName);
    bracket.position = decode_point(in.object("position"));
    return bracket;
}

void decode_limits(ObjectReader& in, VehicleType& type) {
    type.max_speed_mps = in.number("max_speed_mps", kQuantity);
    type.max_accel_mps2 = in.number("max_accel_mps2", kQuantity);
    type.max_turn_rate_radps = in.number("max_turn_rate_radps", kQuantity);
    type.max_turn_accel_radps2 = in.number("max_turn_accel_radps2", kQuantity);
    type.max_steering_rate_radps =
        in.number_or("max_steering_rate_radps", type.max_steering_rate_radps, kQuantity);
    type.min_turn_radius_m = in.number_or("min_turn_radius_m", 0, kQuantity);
    type.max_arc_radius_m = in.number_or("max_arc_radius_m", type.max_arc_radius_m, kQuantity);
    type.clearance_m = in.number("clearance_m", kQuantity);
    type.height_m = in.number_or("height_m", type.height_m, kQuantity);
    type.mass_kg = in.number("mass_kg", kQuantity);
    type.max_load_kg = in.number("max_load_kg", kQuantity);
}

BatteryLimits decode_battery(ObjectReader& in) {
    BatteryLimits limits;
    limits.critical_percent = in.number("critical_percent", kPercent);
    limits.low_percent = in.number("low_percent", kPercent);
    limits.enough_percent = in.number("enough_percent", kPercent);
    in.refuse_unknown();
    return limits;
}

UsualCode decode_usual_code(ObjectReader& in) {
    UsualCode code;
    code.kind = in.one_of("kind", {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark});
    code.size_m = in.number("size_m", kMetres);
    in.refuse_unknown();
    return code;
}

SlipSensor decode_slip_sensor(ObjectReader& in) {
    const SlipSensor sensor{in.number("noise_mps", kQuantity)};
    in.refuse_unknown();
    return sensor;
}

VehicleType decode_vehicle_type(ObjectReader& in) {
    VehicleType type;
    type.id = decode_key<VehicleTypeId>(in, "id");
    type.name = in.text("name", kName);
    type.names = decode_names(in);
    type.kinematics = in.one_of("kinematics", {Kinematics::kSteeredPlatform, Kinematics::kMecanum,
                                               Kinematics::kDifferential});
    type.footprint = decode_ring(in, "footprint");
    type.load_footprint = decode_ring(in, "load_footprint", false);
    decode_limits(in, type);
    if (auto battery = in.object_if_any("battery")) type.battery = decode_battery(*battery);
    if (auto code = in.object_if_any("usual_code")) type.usual_code = decode_usual_code(*code);
    if (auto sensor = in.object_if_any("slip_sensor")) {
        type.slip_sensor = decode_slip_sensor(*sensor);
    }
    in.items("motion_modes", kFew, [&](const Json& item, const std::string& at) {
        const auto mode = parse_motion_mode(json::read_text(item, at, in.errors(), kId));
        if (mode) {
            type.motion_modes.push_back(*mode);
        } else if (item.is_string()) {
            std::string allowed;
            for (const MotionMode m : kMotionModes) {
                allowed += (allowed.empty() ? "" : ", ") + std::string(to_string(m));
            }
            in.errors().add(at, {"not_one_of", {{"allowed", allowed}}},
                            "Expected one of: " + allowed + ".");
        }
    });
    decode_all(in, "wheels", kFew, type.wheels, decode_wheel);
    decode_all(in, "cameras", kFew, type.cameras, decode_camera);
    decode_all(in, "brackets", kFew, type.brackets, decode_bracket);
    return type;
}

Vehicle decode_vehicle(ObjectReader& in) {
    Vehicle vehicle;
    vehicle.id = decode_key<VehicleId>(in, "id");
    vehicle.type = decode_key<VehicleTypeId>(in, "type");
    vehicle.manufacturer = in.text("manufacturer", kId);
    vehicle.serial_number = in.text("serial_number", kId);
    vehicle.name = in.text("name", kName);
    vehicle.home = decode_key<StationId>(in, "home");
    vehicle.load_name = in.text_or("load_name", "", kName);
    vehicle.load_kg = in.number_or("load_kg", 0, kQuantity);
    return vehicle;
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
    in.refuse_unknown();
    return routing;
}

}  // namespace

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
    decode_all(in, "areas", kMany, plant.areas, decode_area);
    decode_all(in, "vehicle_types", kFew, plant.vehicle_types, decode_vehicle_type);
    decode_all(in, "vehicles", kMany, plant.vehicles, decode_vehicle);
    ObjectReader roadmap = in.object("roadmap");
    decode_all(roadmap, "nodes", kMany, plant.nodes, decode_node);
    decode_all(roadmap, "edges", kMany, plant.edges, decode_edge);
    roadmap.refuse_unknown();
    if (auto routing = in.object_if_any("routing")) plant.routing = decode_routing(*routing);
    in.refuse_unknown();
    return plant;
}

}  // namespace pulseline::api::plant_file
