#pragma once

#include <vector>

#include "core/geometry/pose2.hpp"

namespace pulseline::control {

/// One turn of a laser scanner. Ray i points to first_rad + i x step_rad in the sensor's frame (x
/// ahead, counter-clockwise); a range that is not finite or <= 0 is no return.
struct Scan {
    geometry::Pose2 body_from_sensor;
    double first_rad = 0;
    double step_rad = 0;
    std::vector<float> ranges_m;
    bool blind = false;  // its window is dirty or covered, as it says itself
};

}  // namespace pulseline::control
