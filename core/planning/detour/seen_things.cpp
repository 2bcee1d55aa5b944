#include "core/planning/detour/seen_things.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;

Polygon hull_of(const std::vector<Point2>& points) {
    std::vector<Point2> corners;
    const double h = kPoint_m / 2;
    for (const Point2& p : points) {
        for (const Point2 corner : {Point2{h, h}, {-h, h}, {-h, -h}, {h, -h}})
            corners.push_back(p + corner);
    }
    return geometry::convex_hull(std::move(corners));
}

/// Halves the points along their longer extent until each piece is small.
void split(std::vector<Point2> points, std::vector<StandingBody>& things) {
    const auto box = geometry::bounding_box(points);
    const Point2 size = box.max - box.min;
    if (std::max(size.x_m, size.y_m) <= kPiece_m) {
        things.push_back({plant::VehicleId("seen"), {hull_of(points)}});
        return;
    }
    const bool along_x = size.x_m >= size.y_m;
    const Point2 middle = 0.5 * (box.min + box.max);
    const auto second = std::stable_partition(points.begin(), points.end(), [&](Point2 p) {
        return along_x ? p.x_m < middle.x_m : p.y_m < middle.y_m;
    });
    split({points.begin(), second}, things);
    split({second, points.end()}, things);
}

}  // namespace

std::vector<StandingBody> seen_things(std::vector<Point2> points) {
    std::vector<StandingBody> things;
    if (points.empty()) return things;
    std::sort(points.begin(), points.end(),
              [](Point2 a, Point2 b) { return std::tie(a.x_m, a.y_m) < std::tie(b.x_m, b.y_m); });
    split(std::move(points), things);
    return things;
}

}  // namespace pulseline::planning
