#include "core/kinematics/rolling_wheels.hpp"

namespace pulseline::kinematics {

RollingWheels::RollingWheels(const plant::VehicleType& vehicle) : type(vehicle) {
    for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
        if (vehicle.wheels[i].driven) index.push_back(i);
    }
    if (index.size() < 2) {
        index.clear();
        for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) index.push_back(i);
    }
    type.wheels.clear();
    for (const std::size_t i : index) type.wheels.push_back(vehicle.wheels[i]);
}

BodyMotion RollingWheels::body_of(std::span<const WheelMotion> all) const {
    std::vector<WheelMotion> own(index.size());
    for (std::size_t i = 0; i < index.size(); ++i) own[i] = all[index[i]];
    return kinematics::body_of(type, own);
}

}  // namespace pulseline::kinematics
