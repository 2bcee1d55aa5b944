#pragma once

#include <cmath>
#include <cstddef>
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

/// Whether a ray met something.
inline bool is_return(double range_m) { return std::isfinite(range_m) && range_m > 0; }

/// visit(end) where each ray met something, in the frame of `frame_from_sensor`.
template <class Visit>
void visit_ends(const Scan& scan, const geometry::Pose2& frame_from_sensor, Visit visit) {
    for (std::size_t ray = 0; ray < scan.ranges_m.size(); ++ray) {
        const double range_m = scan.ranges_m[ray];
        if (!is_return(range_m)) continue;
        const double angle_rad = scan.first_rad + static_cast<double>(ray) * scan.step_rad;
        visit(frame_from_sensor *
              geometry::Point2{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)});
    }
}

}  // namespace pulseline::control
