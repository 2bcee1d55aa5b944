#include "core/control/seen_points.hpp"

#include <cmath>

namespace pulseline::control {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kThrough_m = 0.15;  // behind a cell: more than cell, noise and odometry together
constexpr double kSure_m = 8;        // no return from farther may be the end of the range

Point2 middle_of(const std::pair<int, int>& cell) {
    return {(cell.first + 0.5) * SeenPoints::kCell_m, (cell.second + 0.5) * SeenPoints::kCell_m};
}

/// The rays at a point and beside it all end well behind it.
bool sees_through(const Scan& scan, Point2 in_sensor) {
    const double away_m = norm(in_sensor);
    if (away_m > kSure_m) return false;
    const double bearing_rad = std::atan2(in_sensor.y_m, in_sensor.x_m);
    const double at = std::round((bearing_rad - scan.first_rad) / scan.step_rad);
    if (at < 1 || at + 2 > static_cast<double>(scan.ranges_m.size())) return false;
    const auto middle = static_cast<std::size_t>(at);
    for (std::size_t i = middle - 1; i <= middle + 1; ++i) {
        const float range_m = scan.ranges_m[i];
        if (is_return(range_m) && range_m < away_m + kThrough_m) return false;
    }
    return true;
}

}  // namespace

void SeenPoints::take(const Scan& scan, const Pose2& hall_from_body) {
    const Pose2 hall_from_sensor = hall_from_body * scan.body_from_sensor;
    const Pose2 sensor_from_hall = inverse(hall_from_sensor);
    std::erase_if(cells_, [&](const Cell& cell) {
        return sees_through(scan, sensor_from_hall * middle_of(cell));
    });
    visit_ends(scan, hall_from_sensor, [&](Point2 end) {
        cells_.emplace(static_cast<int>(std::floor(end.x_m / kCell_m)),
                       static_cast<int>(std::floor(end.y_m / kCell_m)));
    });
}

std::vector<Point2> SeenPoints::points() const {
    std::vector<Point2> points;
    for (const Cell& cell : cells_) points.push_back(middle_of(cell));
    return points;
}

}  // namespace pulseline::control
