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

}  // namespace pulseline::kinematics
