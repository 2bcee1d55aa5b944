#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/plant/plant.hpp"

/// Rows of the plant's tables; `kColumns` and `fields()` list the same names in the same order.
/// set() and get() carry one element over. The doubles live in `element` itself.
namespace pulseline::db {

struct PlantRow {
    static constexpr const char* kTable = "plant";
    static constexpr const char* kColumns =
        "only_one, id, name, revision, k_same, k_diff, reference_step_m, turn_threshold_rad, "
        "accuracy_k, names";
    int only_one = 1;
    std::string id, name, names;
    std::int64_t revision = 1;
    plant::RoutingCost routing;

    auto fields() {
        return std::tie(only_one, id, name, revision, routing.k_same, routing.k_diff,
                        routing.reference_step_m, routing.turn_threshold_rad, routing.accuracy_k,
                        names);
    }
};

/// Halls but for their grid's cells, which go by a blob.
struct HallRow {
    static constexpr const char* kTable = "halls";
    static constexpr const char* kColumns =
        "position, id, name, outline, occupancy_yaml, grid_width, grid_height, grid_resolution_m, "
        "grid_origin_x_m, grid_origin_y_m, names";
    std::int64_t position = 0;
    std::string id, outline, names;
    plant::Hall element;

    auto fields() {
        auto& grid = element.grid;
        return std::tie(position, id, element.name, outline, element.occupancy_yaml, grid.width,
                        grid.height, grid.resolution_m, grid.origin.x_m, grid.origin.y_m, names);
    }
    void set(const plant::Hall& hall);
    plant::Hall get() const;
};

struct NodeRow {
    static constexpr const char* kTable = "nodes";
    static constexpr const char* kColumns = "position, id, hall, x_m, y_m";
    std::int64_t position = 0;
    std::string id, hall;
    plant::RoadmapNode element;

    auto fields() {
        return std::tie(position, id, hall, element.position.x_m, element.position.y_m);
    }
    void set(const plant::RoadmapNode& node);
    plant::RoadmapNode get() const;
};

struct EdgeRow {
    static constexpr const char* kTable = "edges";
    static constexpr const char* kColumns =
        "position, id, from_node, to_node, max_speed_mps, vehicle_types, corridor_left_m, "
        "corridor_right_m";
    std::int64_t position = 0;
    std::string id, from, to, vehicle_types;
    double max_speed_mps = 0;
    plant::Corridor corridor;  // 0 on both sides: none

    auto fields() {
        return std::tie(position, id, from, to, max_speed_mps, vehicle_types, corridor.left_m,
                        corridor.right_m);
    }
    void set(const plant::RoadmapEdge& edge);
    plant::RoadmapEdge get() const;
};

struct VehicleTypeRow {
    static constexpr const char* kTable = "vehicle_types";
    static constexpr const char* kColumns =
        "position, id, name, kinematics, footprint, load_footprint, max_speed_mps, max_accel_mps2, "
        "max_turn_rate_radps, max_turn_accel_radps2, min_turn_radius_m, max_arc_radius_m, "
        "clearance_m, motion_modes, wheels, cameras, brackets, mass_kg, max_load_kg, "
        "battery_critical_percent, battery_low_percent, battery_enough_percent, "
        "max_steering_rate_radps, height_m, usual_code_kind, usual_code_size_m, "
        "slip_sensor_noise_mps, receivers, scanners, navigation_scanner, parking, "
        "load_rules, bracket_lift, casters, control, drive_warm_c, drive_hot_c, names";
    std::int64_t position = 0;
    std::string id, kinematics, footprint, load_footprint, motion_modes, wheels, cameras, receivers,
        scanners, navigation_scanner, brackets, parking, load_rules, bracket_lift, casters, control,
        usual_code_kind, names;
    double slip_sensor_noise_mps = 0;  // 0: none
    plant::VehicleType element;

    auto fields() {
        auto& t = element;
        return std::tie(position, id, t.name, kinematics, footprint, load_footprint,
                        t.max_speed_mps, t.max_accel_mps2, t.max_turn_rate_radps,
                        t.max_turn_accel_radps2, t.min_turn_radius_m, t.max_arc_radius_m,
                        t.clearance_m, motion_modes, wheels, cameras, brackets, t.mass_kg,
                        t.max_load_kg, t.battery.critical_percent, t.battery.low_percent,
                        t.battery.enough_percent, t.max_steering_rate_radps, t.height_m,
                        usual_code_kind, t.usual_code.size_m, slip_sensor_noise_mps, receivers,
                        scanners, navigation_scanner, parking, load_rules, bracket_lift, casters,
                        control, t.drive_temperatures.warm_c, t.drive_temperatures.hot_c, names);
    }
    void set(const plant::VehicleType& type);
    plant::VehicleType get() const;
};

struct MarkerRow {
    static constexpr const char* kTable = "markers";
    static constexpr const char* kColumns =
        "position, id, kind, payload, size_m, hall, x_m, y_m, heading_rad, sigma_xy_m, "
        "sigma_heading_rad";
    std::int64_t position = 0;
    std::string id, kind, hall;
    plant::Marker element;

    auto fields() {
        auto& m = element;
        return std::tie(position, id, kind, m.payload, m.size_m, hall, m.pose.x_m, m.pose.y_m,
                        m.pose.heading_rad, m.sigma_xy_m, m.sigma_heading_rad);
    }
    void set(const plant::Marker& marker);
    plant::Marker get() const;
};

struct TransmitterRow {
    static constexpr const char* kTable = "transmitters";
    static constexpr const char* kColumns =
        "position, id, hall, x_m, y_m, z_m, roll_rad, pitch_rad, heading_rad, rate_hz, first_a, "
        "first_b, first_offset_m, second_a, second_b, second_offset_m, range_m, elevation_rad, "
        "sigma_rad, sigma_place_m, sigma_turn_rad";
    std::int64_t position = 0;
    std::string id, hall;
    plant::Transmitter element;

    auto fields() {
        auto& t = element;
        return std::tie(position, id, hall, t.position.x_m, t.position.y_m, t.z_m, t.roll_rad,
                        t.pitch_rad, t.heading_rad, t.rate_hz, t.first.a, t.first.b,
                        t.first.offset_m, t.second.a, t.second.b, t.second.offset_m, t.range_m,
                        t.elevation_rad, t.sigma_rad, t.sigma_place_m, t.sigma_turn_rad);
    }
    void set(const plant::Transmitter& transmitter);
    plant::Transmitter get() const;
};

struct ReflectorRow {
    static constexpr const char* kTable = "reflectors";
    static constexpr const char* kColumns = "position, id, hall, x_m, y_m, sigma_m";
    std::int64_t position = 0;
    std::string id, hall;
    plant::Reflector element;

    auto fields() {
        auto& r = element;
        return std::tie(position, id, hall, r.position.x_m, r.position.y_m, r.sigma_m);
    }
    void set(const plant::Reflector& reflector);
    plant::Reflector get() const;
};

struct AreaRow {
    static constexpr const char* kTable = "areas";
    static constexpr const char* kColumns = "position, id, kind, name, hall, outline, names";
    std::int64_t position = 0;
    std::string id, kind, name, hall, outline, names;

    auto fields() { return std::tie(position, id, kind, name, hall, outline, names); }
    void set(const plant::Area& area);
    plant::Area get() const;
};

struct StationRow {
    static constexpr const char* kTable = "stations";
    static constexpr const char* kColumns =
        "position, id, number, name, hall, x_m, y_m, heading_rad, tolerance_shape, tolerance_dx_m, "
        "tolerance_dy_m, tolerance_dheading_rad, markers, node, resting_place, vehicle_types, "
        "charger, names, has_support, support_height_m, parks";
    std::int64_t position = 0;
    std::string id, hall, tolerance_shape, markers, node, vehicle_types, names;
    int resting_place = 0, charger = 0, has_support = 0, parks = 0;
    double support_height_m = 0;
    plant::Station element;

    auto fields() {
        auto& s = element;
        return std::tie(position, id, s.number, s.name, hall, s.pose.x_m, s.pose.y_m,
                        s.pose.heading_rad, tolerance_shape, s.tolerance.dx_m, s.tolerance.dy_m,
                        s.tolerance.dheading_rad, markers, node, resting_place, vehicle_types,
                        charger, names, has_support, support_height_m, parks);
    }
    void set(const plant::Station& station);
    plant::Station get() const;
};

struct PlantVehicleRow {
    static constexpr const char* kTable = "vehicles";
    static constexpr const char* kColumns =
        "position, id, type, manufacturer, serial_number, name, home";
    std::int64_t position = 0;
    std::string id, type, home;
    plant::Vehicle element;

    auto fields() {
        auto& v = element;
        return std::tie(position, id, type, v.manufacturer, v.serial_number, v.name, home);
    }
    void set(const plant::Vehicle& vehicle);
    plant::Vehicle get() const;
};

struct LoadRow {
    static constexpr const char* kTable = "loads";
    static constexpr const char* kColumns =
        "position, id, name, kind, model, mass_kg, centre_x_m, centre_y_m, outline, vehicle_types, "
        "vehicle, station, names";
    std::int64_t position = 0;
    std::string id, kind, outline, vehicle_types, vehicle, station, names;
    plant::Load element;

    auto fields() {
        auto& l = element;
        return std::tie(position, id, l.name, kind, l.model, l.mass_kg, l.centre.x_m, l.centre.y_m,
                        outline, vehicle_types, vehicle, station, names);
    }
    void set(const plant::Load& load);
    plant::Load get() const;
};

}  // namespace pulseline::db
