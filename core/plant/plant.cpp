#include "core/plant/plant.hpp"

#include <algorithm>

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

const Load* find_load(const Plant& plant, const LoadId& id) { return find_id(plant.loads, id); }
const Load* first_load(const Plant& plant, const VehicleId& vehicle) {
    if (vehicle.empty()) return nullptr;
    return find(plant.loads, [&](const Load& load) { return load.vehicle == vehicle; });
}

Polygon corridor_band(Point2 from, Point2 to, const Corridor& corridor, double beyond_m) {
    const Point2 ahead = (1 / geometry::distance(from, to)) * (to - from);
    const Point2 left{-ahead.y_m, ahead.x_m};
    const Point2 begin = from - beyond_m * ahead;
    const Point2 end = to + beyond_m * ahead;
    return {begin - corridor.right_m * left, end - corridor.right_m * left,
            end + corridor.left_m * left, begin + corridor.left_m * left};
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

const char* to_string(LoadKind kind) {
    switch (kind) {
        case LoadKind::kAirframe:
            return "airframe";
        case LoadKind::kProduct:
            return "product";
        case LoadKind::kInstrument:
            return "instrument";
    }
    return "product";
}

}  // namespace pulseline::plant
