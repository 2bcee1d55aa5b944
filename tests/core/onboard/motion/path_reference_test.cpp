#include "core/onboard/motion/path_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using simulation::testing::arc;
using simulation::testing::platform_type;
using simulation::testing::straight;
using simulation::testing::turn;

constexpr double kStep_s = 0.01;

TEST(PathReference, TwistIsTheDerivativeOfItsPoses) {
    for (const auto& segment :
         {straight({1, 2, 0.7}, 4, 1.1), arc({0, 0, 0.3}, {-3, 9}, 0.8), turn({2, 1, 3.0}, 1.2)}) {
        PathReference reference(platform_type(), 1);
        reference.append(segment);
        for (int i = 0; i < 300 && !reference.empty(); ++i) {
            const Pose2 before = reference.pose();
            reference.step(kStep_s);
            if (reference.empty()) break;
            const Pose2 moved = inverse(before) * reference.pose();
            const auto twist = reference.twist();

            EXPECT_NEAR(moved.x_m / kStep_s, twist.vx_mps, 5e-4);
            EXPECT_NEAR(moved.y_m / kStep_s, twist.vy_mps, 5e-4);
            EXPECT_NEAR(moved.heading_rad / kStep_s, twist.turn_radps, 1e-6);
        }
    }
}

TEST(PathReference, KeepsToSpeedAndAccelerationInTurnsToo) {
    const auto type = platform_type();
    PathReference reference(type, 1);
    reference.slow_to(0.5);
    reference.append(turn({}, 2.0));
    double before = 0;
    double peak = 0;
    while (!reference.empty()) {
        reference.step(kStep_s);
        const double rate = reference.turn_rate_radps();
        if (!reference.empty()) {
            EXPECT_LE(std::abs(rate - before), type.max_turn_accel_radps2 * kStep_s * 1.01);
        }
        before = rate;
        peak = std::max(peak, rate);
    }
    EXPECT_NEAR(peak, 0.5 * type.max_turn_rate_radps, 1e-9);
}

TEST(PathReference, TellsWhatItPassedAndWhereItRested) {
    PathReference reference(platform_type(), 1);
    reference.append(straight({}, 0.3));
    reference.append(straight({0.3, 0, 0}, 0.2));
    reference.append_fine(turn({0.5, 0, 0}, 0.01));
    double way = 0;
    int rests = 0;
    int fine_ends = 0;
    while (!reference.empty()) {
        for (const auto& passed : reference.step(kStep_s)) {
            if (!passed.fine) way += passed.way;
            rests += passed.rests;
            fine_ends += passed.fine && passed.finished;
        }
    }

    EXPECT_NEAR(way, 0.5, 1e-5);
    EXPECT_EQ(rests, 2);
    EXPECT_EQ(fine_ends, 1);
    EXPECT_EQ(reference.segments_done(), 2u);
}

TEST(PathReference, SlowsDownNoHarderThanItBrakesAndWaitsAtNothing) {
    PathReference reference(platform_type(), 1);
    const double accel = platform_type().max_accel_mps2;
    reference.append(straight({}, 40));
    const auto drive = [&](double time_s) {
        for (double t = 0; t < time_s; t += kStep_s) {
            const double before = reference.velocity_mps();
            reference.step(kStep_s);
            EXPECT_GE(reference.velocity_mps(), before - accel * kStep_s - 1e-9);
        }
    };
    drive(10);
    const double full = reference.velocity_mps();
    reference.slow_to(0.4);
    drive(10);
    EXPECT_NEAR(reference.velocity_mps(), 0.4 * full, 1e-9);
    reference.slow_to(0);
    drive(10);
    EXPECT_TRUE(reference.standing());
    EXPECT_FALSE(reference.empty());
    reference.slow_to(1);
    drive(10);
    EXPECT_NEAR(reference.velocity_mps(), full, 1e-9);
}

TEST(PathReference, LooksAheadAlongTheRunAndNotBehindIt) {
    PathReference reference(platform_type(), 1);
    reference.append(straight({}, 2));
    reference.append(straight({2, 0, 0}, 3));
    reference.append(arc({5, 0, 0}, {5, 10}, 0.5));
    EXPECT_NEAR(reference.run_ahead(), 5, 1e-12);
    EXPECT_NEAR(reference.twist_ahead(4.9).vx_mps, 1, 1e-9);
    EXPECT_NEAR(reference.twist_ahead(4.9).turn_radps, 0, 1e-9);
    while (reference.segments_done() < 2) reference.step(kStep_s);
    EXPECT_NEAR(reference.run_ahead(), 5, 1e-12);
    EXPECT_NEAR(reference.twist_ahead(1).turn_radps, 0.1, 1e-9);
}

TEST(PathReference, CreepsOverFineMoves) {
    PathReference reference(platform_type(), 1);
    reference.append_fine(straight({}, 0.2));
    double peak = 0;
    while (!reference.empty()) {
        reference.step(kStep_s);
        peak = std::max(peak, reference.velocity_mps());
    }
    EXPECT_NEAR(peak, 0.05, 1e-9);
}

}  // namespace
}  // namespace pulseline::onboard
