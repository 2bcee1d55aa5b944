#include "core/kinematics/steered_platform.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/kinematics/arc.hpp"
#include "core/kinematics/motion.hpp"
#include "tests/core/kinematics/tang_platform.hpp"

namespace pulseline::kinematics {
namespace {

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
        const TangPoint drive = to_tang(type.wheels[4].position);
        EXPECT_NEAR(1000 * arc_wheel_path_m(drive, arc->rho_m, arc->gamma_rad(false)), v.path_mm,
                    1e-3);
        const auto theta = arc_wheel_angles_rad(type, arc->rho_m);
        ASSERT_EQ(theta.size(), 6u);
        for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(degrees(theta[i]), v.theta_deg[i], 1e-3);
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

TEST(WheelAngles, PointAlongTheWheelsOwnMotion) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> place(-6, 6);
    for (int i = 0; i < 1000; ++i) {
        const TangPoint wheel{place(random), place(random)};
        const double rho = 20 * place(random);
        const double theta = arc_wheel_angle_rad(wheel, rho);
        // A wheel rolls at right angles to the line to the centre (0, rho).
        const double along = wheel.x_m * std::cos(theta) + (wheel.y_m - rho) * std::sin(theta);
        EXPECT_NEAR(along, 0, 1e-9);
    }
}

TEST(WheelAngles, OfATurnOnTheSpot) {
    const auto type = tang_platform();
    const double expected_deg[] = {79.46, -79.46, -79.46, 79.46, 90, 90};
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(degrees(turn_wheel_angle_rad(to_tang(type.wheels[i].position))),
                    expected_deg[i], 0.005);
    }
}

}  // namespace
}  // namespace pulseline::kinematics
