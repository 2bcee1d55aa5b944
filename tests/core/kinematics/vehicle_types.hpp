#pragma once

#include "core/plant/plant.hpp"

namespace pulseline::kinematics {

/// Tang's platform (Tang 2020, Tables 1 and 2): 10.5 m x 2.5 m, six wheels.
inline plant::VehicleType tang_platform() {
    using plant::MotionMode;
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("platform");
    type.name = "Platform";
    type.footprint = geometry::rectangle(10.5, 2.5);
    type.motion_modes = {MotionMode::kSelfRotation, MotionMode::kLinear,
                         MotionMode::kFixedAxisRotation};
    const auto wheel = [](const char* name, double x_m, double y_m, bool driven) {
        return plant::Wheel{name, {x_m, y_m}, driven, true, 0.5};
    };
    type.wheels = {wheel("FL", 4.970, 0.925, false),     wheel("FR", 4.970, -0.925, false),
                   wheel("BL", -4.970, 0.925, false),    wheel("BR", -4.970, -0.925, false),
                   wheel("drive front", 4.815, 0, true), wheel("drive rear", -4.815, 0, true)};
    return type;
}

/// Wang's platform of the test vector: L1 500 mm, L2 400 mm, R 150 mm.
inline plant::VehicleType mecanum_platform() {
    using plant::MotionMode;
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("mecanum");
    type.name = "Mecanum";
    type.kinematics = plant::Kinematics::kMecanum;
    type.footprint = geometry::rectangle(2.4, 1.6);
    type.motion_modes = {MotionMode::kSelfRotation, MotionMode::kLinear, MotionMode::kLateral,
                         MotionMode::kOblique, MotionMode::kCombined};
    type.wheels = {{"FL", {0.5, 0.4}, true, false, 0.3},
                   {"FR", {0.5, -0.4}, true, false, 0.3},
                   {"RL", {-0.5, 0.4}, true, false, 0.3},
                   {"RR", {-0.5, -0.4}, true, false, 0.3}};
    return type;
}

/// Two wheels, as Li 2020's robot drives.
inline plant::VehicleType differential_vehicle() {
    using plant::MotionMode;
    plant::VehicleType type;
    type.id = plant::VehicleTypeId("differential");
    type.name = "Differential";
    type.kinematics = plant::Kinematics::kDifferential;
    type.footprint = geometry::rectangle(1.6, 1.1);
    type.motion_modes = {MotionMode::kSelfRotation, MotionMode::kLinear,
                         MotionMode::kFixedAxisRotation};
    type.wheels = {{"left", {0, 0.42}, true, false, 0.2}, {"right", {0, -0.42}, true, false, 0.2}};
    return type;
}

}  // namespace pulseline::kinematics
