#include "core/kinematics/wheels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/kinematics/arc.hpp"
#include "core/kinematics/motion.hpp"
#include "tests/core/kinematics/vehicle_types.hpp"

namespace pulseline::kinematics {
namespace {

plant::VehicleType type_of(const char* name, plant::Kinematics kinematics,
                           std::vector<plant::Wheel> wheels) {
    plant::VehicleType type;
    type.name = name;
    type.kinematics = kinematics;
    type.wheels = std::move(wheels);
    return type;
}
plant::VehicleType three_modules() {
    return type_of("modules", plant::Kinematics::kSteeredPlatform,
                   {{"front", {0.8, 0.1}, true, true, 0.2},
                    {"left", {-0.5, 0.6}, true, true, 0.2},
                    {"right", {-0.4, -0.7}, false, true, 0.2}});
}
/// Two fixed wheels behind and one steered wheel in front.
plant::VehicleType one_steered_wheel() {
    return type_of("tricycle", plant::Kinematics::kSteeredPlatform,
                   {{"front", {1.2, 0}, true, true, 0.2},
                    {"left", {0, 0.5}, false, false, 0.2},
                    {"right", {0, -0.5}, false, false, 0.2}});
}

/// Vectors of Tang's Table 4 stations (millimetres and degrees as the paper prints them).
struct ArcVector {
    Pose2 from;
    Pose2 to;
    double rho_mm;
    Point2 centre_mm;
    double gamma_deg;
    double path_mm;
    double arrival_deg;
    double final_turn_deg;  // clockwise
    std::array<double, 6> theta_deg;
};

const std::array<ArcVector, 3> kVectors{{
    {{30, 20, radians(-90)},
     {50, 20, radians(45)},
     -10000,
     {40000, 20000},
     180,
     34868.031,
     90,
     45,
     {-28.708, -24.462, 28.708, 24.462, -25.711, 25.711}},
    {{50, 20, radians(45)},
     {70, 20, radians(-90)},
     14142.136,
     {60000, 10000},
     90,
     23466.679,
     -45,
     45,
     {18.256, 20.608, -18.256, -20.608, 18.802, -18.802}},
    {{70, 20, radians(-90)},
     {85, 20, 0},
     -7500,
     {77500, 20000},
     180,
     27999.721,
     90,
     90,
     {-37.085, -30.537, 37.085, 30.537, -32.700, 32.700}},
}};

TEST(TangsArcVectors, ReproduceByForwardMotion) {
    const auto type = tang_platform();
    for (const ArcVector& v : kVectors) {
        const auto arc = tangent_arc(v.from, v.to.position());
        ASSERT_TRUE(arc);
        EXPECT_NEAR(1000 * arc->rho_m, v.rho_mm, 1e-3);
        EXPECT_NEAR(1000 * arc->centre.x_m, v.centre_mm.x_m, 1e-3);
        EXPECT_NEAR(1000 * arc->centre.y_m, v.centre_mm.y_m, 1e-3);
        EXPECT_NEAR(degrees(arc->gamma_rad(false)), v.gamma_deg, 1e-3);
        EXPECT_NEAR(degrees(arc->arrival_rad), v.arrival_deg, 1e-3);
        EXPECT_NEAR(degrees(wrap(arc->arrival_rad - v.to.heading_rad)), v.final_turn_deg, 1e-3);
        // A unit of speed along the arc; Tang's angles are clockwise.
        const auto wheels = wheels_of(type, {1, 0, -1 / arc->rho_m});
        ASSERT_TRUE(wheels);
        const double time_s = std::abs(arc->rho_m) * arc->gamma_rad(false);
        EXPECT_NEAR(1000 * (*wheels)[4].speed_mps * time_s, v.path_mm, 1e-3);
        ASSERT_EQ(wheels->size(), 6u);
        for (std::size_t w = 0; w < 6; ++w)
            EXPECT_NEAR(degrees(-(*wheels)[w].angle_rad), v.theta_deg[w], 1e-3);
    }
}

TEST(TangsArcVectors, AreWhatTheMotionPlanDrives) {
    for (const ArcVector& v : kVectors) {
        const auto plan =
            plan_motion(tang_platform(), v.from, v.to, plant::MotionMode::kFixedAxisRotation);
        ASSERT_TRUE(plan);
        double gamma = 0;
        double last = 0;
        for (const Segment& segment : plan->segments) {
            if (segment.kind == Segment::Kind::kArc) {
                EXPECT_GT(segment.length_m, 0);  // forwards
                EXPECT_NEAR(1000 * segment.centre.x_m, v.centre_mm.x_m, 1e-3);
                gamma += std::abs(segment.turn_rad);
            } else {
                last += segment.turn_rad;
            }
        }
        EXPECT_NEAR(degrees(gamma), v.gamma_deg, 1e-3);
        EXPECT_NEAR(degrees(-last), v.final_turn_deg, 1e-3);
    }
}

TEST(TangsPlatform, TurnsOnTheSpotWithEveryWheelAcrossItsArm) {
    const auto type = tang_platform();
    const auto wheels = wheels_of(type, {0, 0, 0.1});
    ASSERT_TRUE(wheels);
    const double expected_deg[] = {-79.46, 79.46, 79.46, -79.46, 90, 90};
    for (std::size_t i = 0; i < 6; ++i) {
        const double off = degrees((*wheels)[i].angle_rad) - expected_deg[i];
        EXPECT_NEAR(std::abs(std::remainder(off, 180)), 0, 0.005) << i;
        const auto at = type.wheels[i].position;
        EXPECT_NEAR(std::abs((*wheels)[i].speed_mps), 0.1 * std::hypot(at.x_m, at.y_m), 1e-12);
    }
}

TEST(WangsMecanum, ReproducesTheVectorOfTheCorrectedMatrix) {
    const auto type = mecanum_platform();
    const auto wheels = wheels_of(type, {0.3, 0.1, 0.2});
    ASSERT_TRUE(wheels);
    const double expected_radps[] = {0.13333, 3.86667, 1.46667, 2.53333};
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR((*wheels)[i].speed_mps / 0.150, expected_radps[i], 1e-5);
}

TEST(WangsMecanum, WheelsThatContradictEachOtherAreSlip) {
    const auto type = mecanum_platform();
    auto wheels = wheels_of(type, {0.3, 0.1, 0.2}).value();
    wheels[2].speed_mps += 0.04;
    const BodyMotion body = body_of(type, wheels);
    // |w1 + w2 - w3 - w4| R / 4
    EXPECT_NEAR(body.slip_mps, 0.04 / 4, 1e-12);
}

TEST(Differential, CannotBeMovedSideways) {
    const auto refused = wheels_of(differential_vehicle(), {0.5, 0.1, 0});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "cannot_move_so");
}

/// Law: what the wheels of a twist say is the twist.
TEST(Wheels, OfATwistSayTheTwist) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const auto& type : {tang_platform(), mecanum_platform(), differential_vehicle(),
                             three_modules(), one_steered_wheel()}) {
        for (int i = 0; i < 10'000; ++i) {
            const bool sideways =
                type.kinematics != plant::Kinematics::kDifferential && type.name != "tricycle";
            const Twist twist{1.5 * any(random), sideways ? 1.5 * any(random) : 0, any(random)};
            std::vector<WheelMotion> present(type.wheels.size());
            for (auto& wheel : present) wheel.angle_rad = 1.7 * any(random);
            const auto wheels = wheels_of(type, twist, present);
            ASSERT_TRUE(wheels) << type.name;
            const BodyMotion body = body_of(type, *wheels);
            EXPECT_NEAR(body.twist.vx_mps, twist.vx_mps, 1e-9) << type.name;
            EXPECT_NEAR(body.twist.vy_mps, twist.vy_mps, 1e-9) << type.name;
            EXPECT_NEAR(body.twist.turn_radps, twist.turn_radps, 1e-9) << type.name;
            EXPECT_NEAR(body.slip_mps, 0, 1e-9) << type.name;
        }
    }
}

/// Law: steered wheels stay inside their range, take the shorter way there, and keep their angle at
/// rest.
TEST(Wheels, SteerTheShorterWayInsideTheirRange) {
    const auto type = tang_platform();
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 10'000; ++i) {
        std::vector<WheelMotion> present(type.wheels.size());
        for (auto& wheel : present) wheel.angle_rad = kSteeringLimit_rad * any(random);
        const auto wheels = wheels_of(type, {any(random), any(random), 0.3 * any(random)}, present);
        ASSERT_TRUE(wheels);
        for (std::size_t w = 0; w < wheels->size(); ++w) {
            const double angle = (*wheels)[w].angle_rad;
            EXPECT_LE(std::abs(angle), kSteeringLimit_rad);
            const double other = wrap(angle + kPi);
            if (std::abs(other) <= kSteeringLimit_rad) {
                EXPECT_LE(std::abs(angle - present[w].angle_rad),
                          std::abs(other - present[w].angle_rad) + 1e-12);
            }
        }
        EXPECT_EQ(wheels_of(type, {}, present)->at(3), (WheelMotion{present[3].angle_rad, 0}));
    }
}

/// Law: a limited twist is the same motion, only slower, and no slower than it must be.
TEST(Wheels, LimitsSlowAMotionDownWithoutBendingIt) {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const auto& type : {tang_platform(), mecanum_platform(), differential_vehicle()}) {
        for (int i = 0; i < 10'000; ++i) {
            const bool sideways = type.kinematics != plant::Kinematics::kDifferential;
            const Twist twist{4 * any(random), sideways ? 4 * any(random) : 0, 2 * any(random)};
            const Twist slow = within_limits(type, twist);
            EXPECT_NEAR(slow.vx_mps * twist.turn_radps, twist.vx_mps * slow.turn_radps, 1e-9);
            EXPECT_NEAR(slow.vx_mps * twist.vy_mps, twist.vx_mps * slow.vy_mps, 1e-9);
            double used = std::max(std::hypot(slow.vx_mps, slow.vy_mps) / type.max_speed_mps,
                                   std::abs(slow.turn_radps) / type.max_turn_rate_radps);
            const auto wheels = wheels_of(type, slow);
            ASSERT_TRUE(wheels);
            for (const WheelMotion& wheel : *wheels)
                used = std::max(used, std::abs(wheel.speed_mps) / type.max_speed_mps);
            EXPECT_LE(used, 1 + 1e-12);
            if (slow != twist) {
                EXPECT_NEAR(used, 1, 1e-12);
            }
        }
    }
}

}  // namespace
}  // namespace pulseline::kinematics
