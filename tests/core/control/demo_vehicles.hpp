#pragma once

#include "core/plant/plant.hpp"

/// The vehicles of the demo plants, one of each family.
namespace pulseline::testing {

/// Tang 2020: two drive wheels, four wheels for steering.
inline plant::VehicleType platform() {
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("platform");
    type.name = "Platform";
    type.footprint = geometry::rectangle(10.5, 2.5);
    type.max_speed_mps = 1.67;
    type.max_accel_mps2 = 0.2;
    type.max_turn_rate_radps = 0.12;
    type.max_turn_accel_radps2 = 0.04;
    type.mass_kg = 10200;
    type.max_load_kg = 22000;
    type.wheels = {{"FL", {4.97, 0.925}, false, true, 0.3},
                   {"FR", {4.97, -0.925}, false, true, 0.3},
                   {"BL", {-4.97, 0.925}, false, true, 0.3},
                   {"BR", {-4.97, -0.925}, false, true, 0.3},
                   {"front drive", {4.815, 0}, true, true, 0.41},
                   {"back drive", {-4.815, 0}, true, true, 0.41}};
    type.brackets = {{"front left", {2.4, 0.7}},
                     {"front right", {2.4, -0.7}},
                     {"back left", {-3.0, 0.7}},
                     {"back right", {-3.0, -0.7}}};
    type.parking = plant::usual_parking(type.footprint);
    type.slip_sensor = plant::SlipSensor{0.002};
    type.scanners = plant::usual_scanners(type.footprint);
    return type;
}

/// Wang: four Mecanum wheels.
inline plant::VehicleType mecanum() {
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("mecanum");
    type.name = "Mecanum";
    type.kinematics = plant::Kinematics::kMecanum;
    type.footprint = geometry::rectangle(2.4, 1.4);
    type.max_speed_mps = 1.2;
    type.max_accel_mps2 = 0.4;
    type.max_turn_rate_radps = 0.6;
    type.max_turn_accel_radps2 = 0.4;
    type.mass_kg = 900;
    type.max_load_kg = 400;
    type.wheels = {{"FL", {0.85, 0.55}, true, false, 0.3},
                   {"FR", {0.85, -0.55}, true, false, 0.3},
                   {"BL", {-0.85, 0.55}, true, false, 0.3},
                   {"BR", {-0.85, -0.55}, true, false, 0.3}};
    type.slip_sensor = plant::SlipSensor{0.002};
    type.scanners = plant::usual_scanners(type.footprint);
    return type;
}

/// Li 2020: two drive wheels on one axle.
inline plant::VehicleType differential() {
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("differential");
    type.name = "Differential";
    type.kinematics = plant::Kinematics::kDifferential;
    type.footprint = {{-0.8, -0.55}, {0.35, -0.55}, {0.66, -0.4}, {0.8, 0},
                      {0.66, 0.4},   {0.35, 0.55},  {-0.8, 0.55}};
    type.max_speed_mps = 1.5;
    type.max_accel_mps2 = 0.6;
    type.max_turn_rate_radps = 0.9;
    type.max_turn_accel_radps2 = 0.8;
    type.mass_kg = 180;
    type.max_load_kg = 250;
    type.wheels = {{"left", {0, 0.42}, true, false, 0.2}, {"right", {0, -0.42}, true, false, 0.2}};
    type.slip_sensor = plant::SlipSensor{0.002};
    type.scanners = plant::usual_scanners(type.footprint);
    return type;
}

/// One steered wheel in front of two fixed ones: it cannot move sideways.
inline plant::VehicleType tricycle() {
    plant::VehicleType type;
    type.kinematics = plant::Kinematics::kSteeredPlatform;
    type.footprint = geometry::rectangle(1.6, 1.0);
    type.wheels = {{"front", {1.2, 0}, true, true, 0.2},
                   {"left", {0, 0.5}, false, false, 0.2},
                   {"right", {0, -0.5}, false, false, 0.2}};
    type.slip_sensor = plant::SlipSensor{0.002};
    type.scanners = plant::usual_scanners(type.footprint);
    return type;
}

}  // namespace pulseline::testing
