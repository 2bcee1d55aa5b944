#include "core/onboard/motion/twist_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using kinematics::Twist;
using simulation::testing::platform_type;

constexpr double kStep_s = 0.01;

TEST(TwistReference, TakesOnATwistWithinBothAccelerations) {
    const auto type = platform_type();
    for (const double factor : {1.0, 5.0}) {
        TwistReference reference(type, factor);
        Twist before;
        for (const Twist& asked :
             {Twist{0.4, 0, 0}, Twist{0, -0.3, 0.05}, Twist{-0.2, 0.1, -0.08}, Twist{}}) {
            const Twist scaled{factor * asked.vx_mps, factor * asked.vy_mps,
                               factor * asked.turn_radps};
            reference.ask({}, scaled);
            for (int i = 0; i < 1500; ++i) {
                reference.step(kStep_s / factor, 1);
                const Twist& now = reference.twist();
                EXPECT_LE(std::hypot(now.vx_mps - before.vx_mps, now.vy_mps - before.vy_mps),
                          type.max_accel_mps2 * factor * kStep_s + 1e-9);
                EXPECT_LE(std::abs(now.turn_radps - before.turn_radps),
                          type.max_turn_accel_radps2 * factor * kStep_s + 1e-9);
                before = now;
            }
            EXPECT_NEAR(before.vx_mps, scaled.vx_mps, 1e-12);
            EXPECT_NEAR(before.vy_mps, scaled.vy_mps, 1e-12);
            EXPECT_NEAR(before.turn_radps, scaled.turn_radps, 1e-12);
        }
        EXPECT_FALSE(reference.active());
    }
}

TEST(TwistReference, BrakesOnItsCircleWithinTheWayItTells) {
    TwistReference reference(platform_type(), 1);
    reference.ask({1, 2, 0}, {0.4, 0, 0.04});
    for (int i = 0; i < 1000; ++i) reference.step(kStep_s, 1);
    const Pose2 from = reference.pose();
    const double braking_m = reference.braking_m();
    reference.ask({}, {});
    while (reference.active()) reference.step(kStep_s, 1);
    const Pose2 driven = inverse(from) * reference.pose();
    EXPECT_NEAR(std::hypot(driven.x_m, driven.y_m - 10), 10, 1e-4);
    EXPECT_NEAR(driven.heading_rad * 10, braking_m, 0.005);
    EXPECT_NEAR(std::hypot(reference.pose().x_m - 1, reference.pose().y_m - 12), 10, 1e-3);
}

TEST(TwistReference, EndsWhenItStandsAndIsAskedForNothing) {
    TwistReference reference(platform_type(), 1);
    reference.ask({1, 2, 0}, {});
    EXPECT_FALSE(reference.active());
    reference.ask({1, 2, 0}, {0.1, 0, 0});
    EXPECT_TRUE(reference.active());
    EXPECT_TRUE(reference.standing());
    reference.step(kStep_s, 0);
    EXPECT_EQ(reference.pose(), (Pose2{1, 2, 0}));
    reference.step(kStep_s, 1);
    EXPECT_FALSE(reference.standing());
    reference.shift({10, 0, 0});
    EXPECT_NEAR(reference.pose().x_m, 11, 1e-4);
    while (!reference.standing()) reference.step(kStep_s, 0);
    EXPECT_TRUE(reference.active());
    reference.drop();
    EXPECT_FALSE(reference.active());
}

}  // namespace
}  // namespace pulseline::onboard
