#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/plant/validate.hpp"
#include "tests/core/plant/loads.hpp"

/// A sound plant, and what breaks it.
namespace pulseline::plant {

inline RoadmapNode node(const char* id, double x_m, double y_m) {
    return {NodeId(id), HallId("main"), {x_m, y_m}};
}

inline Station station(int number, const Pose2& pose) {
    Station s;
    s.id = StationId("st" + std::to_string(number));
    s.number = number;
    s.hall = HallId("main");
    s.pose = pose;
    s.node = NodeId("n" + std::to_string(number));
    s.markers = {MarkerId("m" + std::to_string(number))};
    s.resting_place = true;
    s.vehicle_types = {VehicleTypeId("cart")};
    return s;
}

inline Marker marker(int number, const Pose2& pose) {
    Marker m;
    m.id = MarkerId("m" + std::to_string(number));
    m.payload = "ST0" + std::to_string(number) + "-F";
    m.hall = HallId("main");
    m.pose = pose;
    return m;
}

/// A hall of 30 m x 20 m with a column in its grid, two stations, one cart.
inline Plant sound_plant() {
    Plant plant;
    plant.id = "small";
    Hall hall;
    hall.id = HallId("main");
    hall.outline = {{0, 0}, {30, 0}, {30, 20}, {0, 20}};
    hall.grid = {60, 40, 0.5, {0, 0}, std::vector<std::uint8_t>(60 * 40, 0)};
    hall.grid.occupied[20 * 60 + 30] = 1;  // 15 m, 10 m
    plant.halls = {hall};
    VehicleType cart;
    cart.id = VehicleTypeId("cart");
    cart.footprint = geometry::rectangle(4, 2);
    cart.load_footprint = geometry::rectangle(3, 6);
    cart.motion_modes = {MotionMode::kLinear};
    cart.wheels = {{"drive", {1, 0}, true, true, 0.3}};
    Camera front;
    front.name = "front";
    front.body_from_camera = {1.5, 0, 0};
    cart.cameras = {front};
    cart.max_load_kg = 100;
    plant.vehicle_types = {cart};
    plant.stations = {station(1, {6, 10, 0}), station(2, {24, 10, kPi / 2})};
    plant.markers = {marker(1, {7.5, 10, 0}), marker(2, {24, 11.5, 0})};
    plant.areas = {
        {AreaId("z"), AreaKind::kZone, "zone", HallId("main"), {{1, 1}, {9, 1}, {9, 9}}, {}},
        {AreaId("jig"),
         AreaKind::kObstacle,
         "jig",
         HallId("main"),
         {{14, 2}, {16, 2}, {16, 4}, {14, 4}},
         {}}};
    Vehicle first;
    first.id = VehicleId("C-1");
    first.type = VehicleTypeId("cart");
    first.manufacturer = "maker";
    first.serial_number = "C-1";
    first.home = StationId("st1");
    Vehicle second = first;
    second.id = VehicleId("C-2");
    second.serial_number = "C-2";
    second.home = StationId("st2");
    plant.vehicles = {first, second};
    plant.nodes = {node("n1", 6, 10), node("n2", 24, 10), node("mid", 15, 14)};
    plant.edges = {{EdgeId("a"), NodeId("n1"), NodeId("mid"), 0, {}},
                   {EdgeId("b"), NodeId("mid"), NodeId("n1"), 0, {}},
                   {EdgeId("c"), NodeId("mid"), NodeId("n2"), 0, {VehicleTypeId("cart")}},
                   {EdgeId("d"), NodeId("n2"), NodeId("mid"), 0, {}}};
    return plant;
}

struct Case {
    const char* name;
    std::function<void(Plant&)> damage;
    const char* element;
    const char* code;
};

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The fault that `broken` makes is named with a remedy, and little else is.
inline void expect_named(const Case& broken) {
    Plant plant = sound_plant();
    broken.damage(plant);
    const std::vector<Fault> faults = validate(plant);
    std::string found;
    bool named = false;
    for (const Fault& fault : faults) {
        found += fault.element + " " + fault.code + "\n";
        named = named || (fault.element == broken.element && fault.code == broken.code);
        EXPECT_FALSE(fault.what.empty());
        EXPECT_FALSE(fault.remedy.empty());
    }

    EXPECT_TRUE(named) << "found instead:\n" << found;
    EXPECT_LE(faults.size(), 5u) << "one fault should not name the whole plant:\n" << found;
}

/// By its name, for the test runner.
inline std::string name_of(const testing::TestParamInfo<Case>& broken) { return broken.param.name; }

}  // namespace pulseline::plant
