#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/kinematics/motion.hpp"
#include "tests/core/kinematics/tang_platform.hpp"

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
        for (const MotionMode mode : {MotionMode::kLinear, MotionMode::kFixedAxisRotation}) {
            const auto plan = plan_motion(type, from, to, mode);
            if (!plan) continue;
            const auto swept = sweep(body, plan->segments);
            for (const Segment& segment : plan->segments) {
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

}  // namespace
}  // namespace pulseline::kinematics
