#include "core/plant/plant.hpp"

#include <algorithm>

#include "core/geometry/convex.hpp"

namespace pulseline::plant {
namespace {

template <class T, class Match>
const T* find(const std::vector<T>& items, Match match) {
    const auto it = std::find_if(items.begin(), items.end(), match);
    return it == items.end() ? nullptr : &*it;
}

template <class T, class Key>
const T* find_id(const std::vector<T>& items, const Key& id) {
    return find(items, [&](const T& item) { return item.id == id; });
}

}  // namespace

double VehicleType::length_m() const {
    const geometry::Box box = geometry::bounding_box(footprint);
    return box.max.x_m - box.min.x_m;
}

std::vector<LaserScanner> usual_scanners(const Polygon& footprint) {
    const geometry::Box box = geometry::bounding_box(footprint);
    return {{"front left", {box.max.x_m, box.max.y_m, kPi / 4}},
            {"back right", {box.min.x_m, box.min.y_m, -3 * kPi / 4}}};
}

ParkingGear usual_parking(const Polygon& footprint) {
    const geometry::Box box = geometry::bounding_box(footprint);
    return {{{"front left", {box.max.x_m, box.max.y_m}},
             {"front right", {box.max.x_m, box.min.y_m}},
             {"back left", {box.min.x_m, box.max.y_m}},
             {"back right", {box.min.x_m, box.min.y_m}}}};
}

Polygon wheel_base(const VehicleType& type) {
    std::vector<Point2> wheels;
    for (const Wheel& wheel : type.wheels) wheels.push_back(wheel.position);
    return geometry::convex_hull(wheels);
}

const Hall* find_hall(const Plant& plant, const HallId& id) { return find_id(plant.halls, id); }
const Station* find_station(const Plant& plant, const StationId& id) {
    return find_id(plant.stations, id);
}
const Station* find_station(const Plant& plant, int number) {
    return find(plant.stations, [&](const Station& s) { return s.number == number; });
}
const Marker* find_marker(const Plant& plant, const MarkerId& id) {
    return find_id(plant.markers, id);
}
const Marker* find_marker_by_payload(const Plant& plant, const std::string& payload) {
    return find(plant.markers, [&](const Marker& m) { return m.payload == payload; });
}
const VehicleType* find_vehicle_type(const Plant& plant, const VehicleTypeId& id) {
    return find_id(plant.vehicle_types, id);
}
const Vehicle* find_vehicle(const Plant& plant, const VehicleId& id) {
    return find_id(plant.vehicles, id);
}
const Vehicle* find_vehicle(const Plant& plant, const std::string& manufacturer,
                            const std::string& serial_number) {
    return find(plant.vehicles, [&](const Vehicle& v) {
        return v.manufacturer == manufacturer && v.serial_number == serial_number;
    });
}
const RoadmapNode* find_node(const Plant& plant, const NodeId& id) {
    return find_id(plant.nodes, id);
}

bool is_loaded(const Vehicle& vehicle) { return vehicle.load_kg > 0 || !vehicle.load_name.empty(); }

std::vector<Camera> cameras_of(const VehicleType& type, bool loaded) {
    std::vector<Camera> cameras = type.cameras;
    for (Camera& camera : cameras) {
        if (!loaded || !camera.loaded) continue;
        static_cast<CameraMounting&>(camera) = *camera.loaded;
    }
    return cameras;
}

double reach_m(const std::vector<Polygon>& outline) {
    double reach_m = 0;
    for (const Polygon& piece : outline) {
        for (const Point2 corner : piece) reach_m = std::max(reach_m, norm(corner));
    }
    return reach_m;
}

Polygon corridor_band(Point2 from, Point2 to, const Corridor& corridor, double beyond_m) {
    const Point2 ahead = (1 / geometry::distance(from, to)) * (to - from);
    const Point2 left{-ahead.y_m, ahead.x_m};
    const Point2 begin = from - beyond_m * ahead;
    const Point2 end = to + beyond_m * ahead;
    return {begin - corridor.right_m * left, end - corridor.right_m * left,
            end + corridor.left_m * left, begin + corridor.left_m * left};
}

std::vector<Polygon> outline_with_load(const VehicleType& type, bool loaded) {
    std::vector<Polygon> pieces = geometry::convex_pieces(type.footprint);
    if (loaded && !type.load_footprint.empty()) {
        for (Polygon& piece : geometry::convex_pieces(type.load_footprint)) {
            pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

const char* to_string(MotionMode mode) {
    switch (mode) {
        case MotionMode::kAuto:
            return "auto";
        case MotionMode::kSelfRotation:
            return "self_rotation";
        case MotionMode::kLinear:
            return "linear";
        case MotionMode::kFixedAxisRotation:
            return "fixed_axis_rotation";
        case MotionMode::kLateral:
            return "lateral";
        case MotionMode::kOblique:
            return "oblique";
        case MotionMode::kCombined:
            return "combined";
        case MotionMode::kFree:
            return "free";
    }
    return "auto";
}

std::optional<MotionMode> parse_motion_mode(const std::string& text) {
    for (const MotionMode mode : kMotionModes) {
        if (text == to_string(mode)) return mode;
    }
    return std::nullopt;
}

std::optional<MarkerKind> parse_marker_kind(const std::string& name) {
    for (const MarkerKind kind : {MarkerKind::kQr, MarkerKind::kAprilTag, MarkerKind::kLandmark}) {
        if (name == to_string(kind)) return kind;
    }
    return std::nullopt;
}

const char* to_string(Kinematics kinematics) {
    switch (kinematics) {
        case Kinematics::kSteeredPlatform:
            return "steered_platform";
        case Kinematics::kMecanum:
            return "mecanum";
        case Kinematics::kDifferential:
            return "differential";
    }
    return "steered_platform";
}

const char* to_string(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::kQr:
            return "qr";
        case MarkerKind::kAprilTag:
            return "apriltag";
        case MarkerKind::kLandmark:
            return "landmark";
    }
    return "qr";
}

const char* to_string(AreaKind kind) {
    switch (kind) {
        case AreaKind::kZone:
            return "zone";
        case AreaKind::kLane:
            return "lane";
        case AreaKind::kNoGo:
            return "no_go";
        case AreaKind::kObstacle:
            return "obstacle";
    }
    return "zone";
}

const char* to_string(Tolerance::Shape shape) {
    return shape == Tolerance::Shape::kBox ? "box" : "ellipse";
}

}  // namespace pulseline::plant
