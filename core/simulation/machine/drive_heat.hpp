#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/kinematics/wheels.hpp"

namespace pulseline::simulation {

/// How warm the servo drives of a vehicle's wheels are, and which have switched themselves off
/// because they were too hot (plant::DriveTemperatures). In the vehicle's own time. No clock.
class DriveHeat {
public:
    explicit DriveHeat(const plant::VehicleType& type);

    /// So much time with its wheels rolling so, one of them a wheel of the type, in its own speeds.
    void step(double own_s, std::span<const kinematics::WheelMotion> rolling);
    /// The wheel runs hot when it turns. False: there is no such wheel.
    bool seize_bearing(const std::string& wheel);

    double temperature_c(std::size_t wheel) const { return drives_[wheel].temperature_c; }
    /// It was too hot, and is not yet cooler than warm_c.
    bool is_off(std::size_t wheel) const { return drives_[wheel].off; }

private:
    struct Drive {
        std::string wheel;
        double temperature_c = 0;
        bool grinds = false;
        bool off = false;
    };

    plant::DriveTemperatures limits_;
    double full_mps_;
    std::vector<Drive> drives_;
};

}  // namespace pulseline::simulation
