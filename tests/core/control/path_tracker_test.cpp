#include "core/control/path_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::control {
namespace {

constexpr double kStep_s = 0.01;

Pose2 moved(const Pose2& pose, const Twist& twist, double h_s) {
    const Pose2 halfway = pose * Pose2{0, 0, twist.turn_radps * h_s / 2};
    const Pose2 shifted = halfway * Pose2{twist.vx_mps * h_s, twist.vy_mps * h_s, 0};
    return {shifted.x_m, shifted.y_m, wrap(pose.heading_rad + twist.turn_radps * h_s)};
}

/// What is left of `offset`, seen from the reference, after `seconds` on a steady twist.
Pose2 left_over(const plant::VehicleType& type, const Twist& twist, const Pose2& offset,
                double seconds) {
    Reference reference{{3, -2, 2.5}, twist};
    Pose2 vehicle = reference.pose * offset;
    for (double t = 0; t < seconds; t += kStep_s) {
        vehicle = moved(vehicle, track(type, reference, vehicle), kStep_s);
        reference.pose = moved(reference.pose, reference.twist, kStep_s);
    }
    return inverse(reference.pose) * vehicle;
}

void expect_small(const Pose2& off) {
    EXPECT_LT(norm(off.position()), 1e-3);
    EXPECT_LT(std::abs(off.heading_rad), 1e-3);
}

TEST(PathTracker, AnOmnidirectionalVehicleComesBackToItsPathHoweverItMoves) {
    const Pose2 offset{-0.03, 0.05, 0.02};
    for (const auto& type : {pulseline::testing::platform(), pulseline::testing::mecanum()}) {
        expect_small(left_over(type, {0.6, 0, 0}, offset, 20));
        expect_small(left_over(type, {-0.6, 0, 0}, offset, 20));
        expect_small(left_over(type, {0.2, 0.5, 0}, offset, 20));
        expect_small(left_over(type, {0.5, 0, 0.05}, offset, 20));
    }
}

TEST(PathTracker, ADifferentialVehicleComesBackForwardsAndBackwards) {
    const Pose2 offset{-0.03, 0.05, 0.02};
    for (const double vx : {0.8, -0.8}) {
        expect_small(left_over(pulseline::testing::differential(), {vx, 0, 0}, offset, 25));
        expect_small(left_over(pulseline::testing::differential(), {vx, 0, 0.1}, offset, 25));
    }
}

TEST(PathTracker, OnTheReferenceItAsksForTheReferencesTwist) {
    const Reference reference{{1, 2, 0.4}, {0.3, 0, 0.1}};
    for (const auto& type : {pulseline::testing::platform(), pulseline::testing::mecanum(), pulseline::testing::differential()}) {
        const Twist twist = track(type, reference, reference.pose);
        EXPECT_NEAR(twist.vx_mps, 0.3, 1e-12);
        EXPECT_NEAR(twist.vy_mps, 0, 1e-12);
        EXPECT_NEAR(twist.turn_radps, 0.1, 1e-12);
    }
}

TEST(PathTracker, NeverExceedsLimitsNorAsksADifferentialVehicleToMoveSideways) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const auto& type : {pulseline::testing::platform(), pulseline::testing::mecanum(), pulseline::testing::differential()}) {
        const bool differential = type.kinematics == plant::Kinematics::kDifferential;
        for (int i = 0; i < 2000; ++i) {
            const Reference reference{
                {any(random), any(random), 3 * any(random)},
                {2 * any(random), differential ? 0 : 2 * any(random), any(random)}};
            const Pose2 estimated = reference.pose * Pose2{any(random), any(random), any(random)};
            const Twist twist = track(type, reference, estimated);
            const Twist limited = kinematics::within_limits(type, twist);
            EXPECT_NEAR(limited.vx_mps, twist.vx_mps, 1e-12);
            EXPECT_NEAR(limited.turn_radps, twist.turn_radps, 1e-12);
            if (differential) {
                EXPECT_EQ(twist.vy_mps, 0);
            }
        }
    }
}

TEST(PathTracker, DoesNotMoveAStandingVehicle) {
    const Twist twist = track(pulseline::testing::mecanum(), {{0.1, 0.1, 0.1}, {}}, {});
    EXPECT_EQ(twist, Twist{});
}

}  // namespace
}  // namespace pulseline::control
