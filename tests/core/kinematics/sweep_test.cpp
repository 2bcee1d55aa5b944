#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/kinematics/primitives.hpp"
#include "tests/core/kinematics/vehicle_types.hpp"

namespace pulseline::kinematics {
namespace {

using geometry::Polygon;

double area_of(const std::vector<Polygon>& pieces) {
    double area = 0;
    for (const Polygon& ring : geometry::union_outline(pieces)) area += geometry::area_m2(ring);
    return area;
}

TEST(Sweep, HoldsTheBodyAtEveryMoment) {
    plant::VehicleType type = tang_platform();
    type.motion_modes.push_back(MotionMode::kLateral);
    const std::vector<Polygon> body{geometry::rectangle(10.5, 2.5),
                                    {{2, -4}, {4, -4}, {4, 4}, {2, 4}}};
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-30, 30);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    int checked = 0;
    for (int i = 0; i < 40; ++i) {
        const Pose2 from{place(random), place(random), turn(random)};
        const Pose2 to{place(random), place(random), turn(random)};
        for (const MotionMode mode :
             {MotionMode::kLinear, MotionMode::kFixedAxisRotation, MotionMode::kCombined}) {
            std::vector<Segment> segments;
            if (mode == MotionMode::kCombined) {
                append_combined(segments, from, to.position(), to.heading_rad);
            } else if (const auto plan = plan_motion(type, from, to, mode)) {
                segments = plan->segments;
            }
            const auto swept = sweep(body, segments);
            for (const Segment& segment : segments) {
                for (int k = 0; k <= 101; ++k) {
                    const Pose2 pose = pose_at(segment, k / 101.0);
                    for (const Polygon& piece : body) {
                        for (const Point2& corner : geometry::transformed(pose, piece)) {
                            ++checked;
                            EXPECT_TRUE(std::any_of(
                                swept.begin(), swept.end(),
                                [&](const Polygon& p) { return geometry::contains(p, corner); }));
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(checked, 50'000);
}

TEST(Sweep, IsHardlyLargerThanTheTrueArea) {
    const std::vector<Polygon> body{geometry::rectangle(10.5, 2.5)};
    const auto turn =
        plan_motion(tang_platform(), {0, 0, 0}, {0, 0, kPi}, MotionMode::kSelfRotation);
    const auto straight = plan_motion(tang_platform(), {0, 0, 1},
                                      {30 * std::cos(1), 30 * std::sin(1), 1}, MotionMode::kLinear);
    ASSERT_TRUE(turn);
    ASSERT_TRUE(straight);

    const double disc = kPi * (5.25 * 5.25 + 1.25 * 1.25);
    EXPECT_NEAR(area_of(sweep(body, turn->segments)), disc, 0.005 * disc);
    EXPECT_NEAR(area_of(sweep(body, straight->segments)), 40.5 * 2.5, 1e-3);
}

/// Against a fine grid of points: what lies in the sweep and in no sampled body.
TEST(Sweep, OfACombinedMoveIsHardlyLargerThanItsBodies) {
    const std::vector<Polygon> body{geometry::rectangle(3.2, 2.1)};
    std::vector<Segment> segments;
    append_combined(segments, {0, 0, 0}, {6, 0}, 2);
    const auto swept = sweep(body, segments);
    std::vector<Polygon> bodies;
    for (const Segment& segment : segments)
        for (int k = 0; k <= 200; ++k)
            bodies.push_back(geometry::transformed(pose_at(segment, k / 200.0), body.front()));
    const auto holds = [](const std::vector<Polygon>& pieces, Point2 point) {
        return std::any_of(pieces.begin(), pieces.end(),
                           [&](const Polygon& p) { return geometry::contains(p, point); });
    };
    int in_bodies = 0;
    int in_sweep = 0;
    for (double x = -3; x < 9; x += 0.05) {
        for (double y = -3; y < 3; y += 0.05) {
            in_bodies += holds(bodies, {x, y});
            in_sweep += holds(swept, {x, y});
        }
    }
    EXPECT_GE(in_sweep, in_bodies);
    EXPECT_LT(in_sweep, 1.01 * in_bodies);
}

}  // namespace
}  // namespace pulseline::kinematics
