#pragma once

#include <cmath>
#include <vector>

#include "core/planning/detour/detour.hpp"
#include "tests/core/control/demo_vehicles.hpp"

/// A straight stretch of lanes with corridors and things on it, for tests of detours. Things and
/// expectations are in the frame of the line: x along the way from its beginning, y to the left.
namespace pulseline::planning::testing {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;
using plant::MotionMode;

/// The vehicles of the demo plants with what their types list.
inline std::vector<plant::VehicleType> families() {
    auto platform = pulseline::testing::platform();
    platform.min_turn_radius_m = 5;
    platform.motion_modes = {MotionMode::kSelfRotation, MotionMode::kLinear,
                             MotionMode::kFixedAxisRotation, MotionMode::kFree};
    auto mecanum = pulseline::testing::mecanum();
    mecanum.motion_modes = {MotionMode::kSelfRotation, MotionMode::kLinear, MotionMode::kLateral,
                            MotionMode::kFree};
    auto differential = pulseline::testing::differential();
    differential.motion_modes = {MotionMode::kSelfRotation, MotionMode::kLinear, MotionMode::kFree};
    return {platform, mecanum, differential};
}

inline double reach_m(const plant::VehicleType& type) {
    double reach = 0;
    for (const Point2& corner : type.footprint) reach = std::max(reach, norm(corner));
    return reach;
}
inline double front_m(const plant::VehicleType& type) {
    return geometry::bounding_box(type.footprint).max.x_m;
}
inline double half_width_m(const plant::VehicleType& type) {
    return geometry::bounding_box(type.footprint).max.y_m;
}

struct DetourWorld {
    explicit DetourWorld(const plant::VehicleType& of, int edges = 8, double side_m = 2.5)
        : type(of) {
        for (int i = 0; i < edges; ++i)
            add_edge(4, half_width_m(of) + side_m, half_width_m(of) + side_m);
    }
    void add_edge(double length_m, double left_m, double right_m) {
        const double from_m = end_m();
        stretch.push_back({hall_from_line * Pose2{from_m, 0, 0},
                           hall_from_line * Pose2{from_m + length_m, 0, 0},
                           {left_m, right_m}});
        ends_m.push_back(from_m + length_m);
    }
    double end_m() const { return ends_m.empty() ? 0 : ends_m.back(); }
    /// What is seen of it: points of its outline, 4 cm apart.
    void put(const Polygon& thing) {
        things.push_back(thing);
        for (std::size_t i = 0; i < thing.size(); ++i) {
            const Point2 along = thing[(i + 1) % thing.size()] - thing[i];
            for (double s = 0; s < 1; s += 0.04 / norm(along))
                seen.push_back(hall_from_line * (thing[i] + s * along));
        }
    }
    void put_box(double x_m, double y_m, double size_m = 0.5) {
        put(geometry::transformed({x_m, y_m, 0}, geometry::rectangle(size_m, size_m)));
    }
    DetourRequest request(const Pose2& start) const {
        return {&type, false, hall_from_line * start, stretch, seen};
    }

    plant::VehicleType type;
    Pose2 hall_from_line{31, 17, 0.7};
    std::vector<DetourEdge> stretch;
    std::vector<double> ends_m;
    std::vector<Polygon> things;
    std::vector<Point2> seen;
};

}  // namespace pulseline::planning::testing
