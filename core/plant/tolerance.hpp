#pragma once

#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::plant {

/// How far from the drawing a vehicle stands at a station.
struct Deviation {
    double dx_m = 0;  // hall frame: measured minus theoretical
    double dy_m = 0;
    double dheading_rad = 0;  // wrapped
    double along_m = 0;       // station frame: ahead of it
    double left_m = 0;        // and to the left of it
    bool inside = false;      // of the station's tolerance, in the hall frame
};
Deviation deviation(const Station& station, const geometry::Pose2& measured);

}  // namespace pulseline::plant
