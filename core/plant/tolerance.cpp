#include "core/plant/tolerance.hpp"

#include <cmath>

namespace pulseline::plant {
namespace {

bool is_inside(const Tolerance& tolerance, const Deviation& by) {
    if (std::abs(by.dheading_rad) > tolerance.dheading_rad) return false;
    if (tolerance.shape == Tolerance::Shape::kBox) {
        return std::abs(by.dx_m) <= tolerance.dx_m && std::abs(by.dy_m) <= tolerance.dy_m;
    }
    return std::hypot(by.dx_m / tolerance.dx_m, by.dy_m / tolerance.dy_m) <= 1.0;
}

}  // namespace

Deviation deviation(const Station& station, const geometry::Pose2& measured) {
    const geometry::Pose2 station_from_vehicle = geometry::inverse(station.pose) * measured;
    Deviation by{measured.x_m - station.pose.x_m,
                 measured.y_m - station.pose.y_m,
                 wrap(measured.heading_rad - station.pose.heading_rad),
                 station_from_vehicle.x_m,
                 station_from_vehicle.y_m,
                 false};
    by.inside = is_inside(station.tolerance, by);
    return by;
}

}  // namespace pulseline::plant
