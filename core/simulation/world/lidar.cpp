#include "core/simulation/world/lidar.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace pulseline::simulation {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr float kNoReturn = std::numeric_limits<float>::infinity();

template <class Visit>
void visit_edges(const geometry::Polygon& polygon, Visit visit) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        visit(polygon[i], polygon[(i + 1) % polygon.size()]);
    }
}

/// Pose2 * point with the sine and cosine already known.
struct Rotation {
    explicit Rotation(const Pose2& pose)
        : c(std::cos(pose.heading_rad)), s(std::sin(pose.heading_rad)), origin(pose.position()) {}
    Point2 operator()(Point2 p) const {
        return {origin.x_m + c * p.x_m - s * p.y_m, origin.y_m + s * p.x_m + c * p.y_m};
    }
    double c;
    double s;
    Point2 origin;
};

}  // namespace

Lidar::Lidar(plant::LaserScanner scanner, std::span<const geometry::Polygon> fixed)
    : scanner_(std::move(scanner)) {
    assert(scanner_.step_rad > 0 && scanner_.field_rad > 0 && scanner_.field_rad < 2 * kPi);
    for (const auto& polygon : fixed) {
        visit_edges(polygon, [&](Point2 a, Point2 b) { fixed_.push_back({a, b}); });
    }
    const int rays = 1 + static_cast<int>(std::lround(scanner_.field_rad / scanner_.step_rad));
    for (int i = 0; i < rays; ++i) {
        const double angle = -scanner_.field_rad / 2 + i * scanner_.step_rad;
        rays_.push_back({std::cos(angle), std::sin(angle)});
    }
}

void Lidar::scan(const Pose2& hall_from_body, std::span<const geometry::Polygon> others,
                 std::mt19937_64& random, control::Scan& scan) const {
    scan.body_from_sensor = scanner_.body_from_scanner;
    scan.first_rad = -scanner_.field_rad / 2;
    scan.step_rad = scanner_.step_rad;
    scan.ranges_m.assign(rays_.size(), kNoReturn);
    const Rotation sensor_from_hall(inverse(hall_from_body * scanner_.body_from_scanner));
    const auto cover = [&](Point2 a, Point2 b) {
        cover_edge(sensor_from_hall(a), sensor_from_hall(b), scan.ranges_m);
    };
    for (const Edge& edge : fixed_) cover(edge.from, edge.to);
    for (const auto& polygon : others) visit_edges(polygon, cover);

    std::normal_distribution<double> normal;
    for (float& range : scan.ranges_m) {
        if (range < scanner_.least_range_m || range > scanner_.range_m) {
            range = kNoReturn;
            continue;
        }
        const double error = std::clamp(scanner_.sigma_m * normal(random), -scanner_.most_error_m,
                                        scanner_.most_error_m);
        range = static_cast<float>(range + error);
    }
}

void Lidar::cover_edge(Point2 a, Point2 b, std::vector<float>& ranges_m) const {
    const Point2 way = b - a;
    const double length2 = dot(way, way);
    const double share = length2 > 0 ? std::clamp(-dot(a, way) / length2, 0.0, 1.0) : 0.0;
    const Point2 nearest = a + share * way;
    if (dot(nearest, nearest) > scanner_.range_m * scanner_.range_m) return;
    const double side = cross(a, b);
    if (side == 0) return;  // seen end on
    if (side < 0) std::swap(a, b);
    const double from_rad = std::atan2(a.y_m, a.x_m);
    double to_rad = std::atan2(b.y_m, b.x_m);
    if (to_rad < from_rad) to_rad += 2 * kPi;
    cover_rays(from_rad, to_rad, a, b - a, ranges_m);
    if (to_rad > kPi) cover_rays(from_rad - 2 * kPi, to_rad - 2 * kPi, a, b - a, ranges_m);
}

/// The rays between two bearings meet the line from `from` along `along`.
void Lidar::cover_rays(double from_rad, double to_rad, Point2 from, Point2 along,
                       std::vector<float>& ranges_m) const {
    const double first = (from_rad + scanner_.field_rad / 2) / scanner_.step_rad;
    const double last = (to_rad + scanner_.field_rad / 2) / scanner_.step_rad;
    const auto count = static_cast<double>(ranges_m.size());
    if (last < 0 || first > count - 1) return;
    const auto begin = static_cast<std::size_t>(std::max(0.0, std::ceil(first)));
    const auto end = static_cast<std::size_t>(std::min(count - 1, std::floor(last)) + 1);
    const double reach = cross(from, along);
    for (std::size_t i = begin; i < end; ++i) {
        const double range = reach / cross(rays_[i], along);
        if (range > 0 && range < ranges_m[i]) ranges_m[i] = static_cast<float>(range);
    }
}

}  // namespace pulseline::simulation
