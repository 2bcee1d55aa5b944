#include "core/control/protective_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::control {
namespace {

using geometry::Point2;
using geometry::Pose2;
using pulseline::testing::differential;
using pulseline::testing::mecanum;
using Verdict = FieldAnswer::Verdict;

constexpr Pose2 kMount{0.5, 0.2, 0.3};

/// A scan with single returns at places of the body frame.
Scan scan_of(std::initializer_list<Point2> places) {
    Scan scan{kMount, -kPi, radians(0.25), {}};
    scan.ranges_m.assign(1440, std::numeric_limits<float>::infinity());
    for (const Point2 place : places) {
        const Point2 at = inverse(kMount) * place;
        const double ray = (std::atan2(at.y_m, at.x_m) + kPi) / scan.step_rad;
        scan.ranges_m[static_cast<std::size_t>(std::lround(ray)) % 1440] =
            static_cast<float>(norm(at));
    }
    return scan;
}

class ProtectiveFieldsTest : public ::testing::Test {
protected:
    plant::VehicleType type = mecanum();  // 2.4 m x 1.4 m, 0.4 m/s^2
    ProtectiveFields fields{type, type.footprint};
    FieldOptions options;

    Verdict verdict(Point2 place, const kinematics::Twist& twist) {
        return fields.check(scan_of({place}), twist).verdict;
    }
};

TEST_F(ProtectiveFieldsTest, StopFieldIsTheStoppingWayAndTheMargin) {
    for (const double v : {0.2, 0.5, 1.0}) {
        const double stopping_m = v * options.reaction_s + v * v / (2 * type.max_accel_mps2);
        const double edge_m = 1.2 + options.margin_m + stopping_m;
        EXPECT_EQ(verdict({edge_m - 0.02, 0}, {v, 0, 0}), Verdict::kStop);
        EXPECT_EQ(verdict({edge_m + 0.02, 0}, {v, 0, 0}), Verdict::kSlow);
        EXPECT_EQ(verdict({edge_m + v * options.look_ahead_s - 0.02, 0}, {v, 0, 0}),
                  Verdict::kSlow);
        EXPECT_EQ(verdict({edge_m + v * options.look_ahead_s + 0.02, 0}, {v, 0, 0}),
                  Verdict::kFree);
    }
}

TEST_F(ProtectiveFieldsTest, FollowsTheTwist) {
    const Point2 ahead{1.5, 0};
    const Point2 left{0, 1.0};
    EXPECT_EQ(verdict(ahead, {0.5, 0, 0}), Verdict::kStop);
    EXPECT_EQ(verdict(ahead, {-0.5, 0, 0}), Verdict::kFree);
    EXPECT_EQ(verdict(ahead, {0, 0.5, 0}), Verdict::kFree);
    EXPECT_EQ(verdict(left, {0, 0.5, 0}), Verdict::kStop);
    EXPECT_EQ(verdict(left, {0.5, 0, 0}), Verdict::kFree);
    // A turn sweeps its corners: left ahead and right behind.
    EXPECT_EQ(verdict({1.1, 0.85}, {0, 0, 0.5}), Verdict::kStop);
    EXPECT_EQ(verdict({-1.1, -0.85}, {0, 0, 0.5}), Verdict::kStop);
    EXPECT_EQ(verdict({1.1, -0.95}, {0, 0, 0.5}), Verdict::kFree);
}

TEST_F(ProtectiveFieldsTest, AtTheSlowedSpeedTheSlowFieldIsJustFree) {
    for (double x_m = 1.9; x_m < 3.5; x_m += 0.1) {
        const auto answer = fields.check(scan_of({{x_m, 0}}), {0.8, 0, 0});
        if (answer.verdict != Verdict::kSlow) continue;
        ASSERT_GT(answer.speed_mps, 0);
        ASSERT_LT(answer.speed_mps, 0.8);
        const double v = answer.speed_mps;
        EXPECT_NE(verdict({x_m, 0}, {0.98 * v, 0, 0}), Verdict::kSlow);
        EXPECT_EQ(verdict({x_m, 0}, {1.02 * v, 0, 0}), Verdict::kSlow);
        EXPECT_NEAR(answer.way_m, x_m - 1.2 - options.margin_m, 0.015);
    }
}

TEST_F(ProtectiveFieldsTest, AVehicleThatObeysNeverComesIntoTheMargin) {
    const double wall_m = 5;
    const double dt_s = 0.1;
    double x_m = 0;
    double v = 0;
    for (int i = 0; i < 600; ++i) {
        const double wanted = std::min(1.0, v + type.max_accel_mps2 * dt_s);
        const auto answer =
            fields.check(scan_of({{wall_m - x_m, 0}, {wall_m - x_m, 0.3}}), {wanted, 0, 0});
        v = std::max(std::min(wanted, answer.speed_mps), v - type.max_accel_mps2 * dt_s);
        x_m += v * dt_s;
        ASSERT_GE(wall_m - x_m - 1.2, options.margin_m - 0.01);
    }
    EXPECT_LT(wall_m - x_m - 1.2, options.margin_m + 0.15);
}

TEST_F(ProtectiveFieldsTest, NamesTheReturnThatIsMetFirst) {
    const Point2 first{2.0, 0.3};
    const auto answer =
        fields.check(scan_of({{2.4, -0.2}, first, {1.0, 1.5}, {2.2, 0.1}}), {0.5, 0, 0});
    ASSERT_TRUE(answer.nearest);
    EXPECT_LT(distance(*answer.nearest, first), 0.01);
}

TEST_F(ProtectiveFieldsTest, LetsAVehicleLeaveWhatItStandsBeside) {
    EXPECT_EQ(verdict({1.25, 0}, {0.3, 0, 0}), Verdict::kStop);
    EXPECT_EQ(verdict({1.25, 0}, {-0.3, 0, 0}), Verdict::kFree);
    EXPECT_EQ(verdict({0, 0.75}, {0.3, 0, 0}), Verdict::kFree);  // along a wall
    EXPECT_EQ(verdict({1.25, 0}, {}), Verdict::kFree);           // standing
}

TEST_F(ProtectiveFieldsTest, InsideTheOutlineIsAlwaysAStop) {
    EXPECT_EQ(verdict({0.9, 0.5}, {-0.2, 0, 0}), Verdict::kStop);
}

/// The swept area by brute force: thousands of poses along the motion.
TEST_F(ProtectiveFieldsTest, AgreesWithTheSweptOutline) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> share(-1, 1);
    for (const auto& vehicle : {differential(), mecanum()}) {
        ProtectiveFields own(vehicle, vehicle.footprint);
        const ObstacleRing outline(vehicle.footprint);
        int stops = 0;
        for (int run = 0; run < 900; ++run) {
            const kinematics::Twist twist{0.6 * share(random), 0, 0.5 * share(random)};
            const Scan scan = scan_of({{1.4 * share(random), 1.4 * share(random)}});
            Point2 place;  // as the ray has it
            for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
                if (!std::isfinite(scan.ranges_m[i])) continue;
                const double angle = scan.first_rad + static_cast<double>(i) * scan.step_rad;
                place = kMount * Point2{scan.ranges_m[i] * std::cos(angle),
                                        scan.ranges_m[i] * std::sin(angle)};
            }
            if (outline.outline_distance_m(place) <= options.margin_m) continue;
            const double stopping_s =
                options.reaction_s +
                std::max(std::abs(twist.vx_mps) / vehicle.max_accel_mps2,
                         std::abs(twist.turn_radps) / vehicle.max_turn_accel_radps2) /
                    2;
            double least_m = 10;
            Pose2 body;
            constexpr int kSteps = 2000;
            for (int i = 0; i < kSteps; ++i) {
                least_m = std::min(least_m, outline.outline_distance_m(inverse(body) * place));
                const double dt_s = stopping_s / kSteps;
                body = body * Pose2{twist.vx_mps * dt_s, 0, twist.turn_radps * dt_s};
            }
            const bool stop = own.check(scan, twist).verdict == Verdict::kStop;
            stops += stop;
            if (least_m < options.margin_m - 0.005) {
                EXPECT_TRUE(stop);
            }
            if (least_m > options.margin_m + 0.012) {
                EXPECT_FALSE(stop);
            }
        }
        EXPECT_GT(stops, 10);
    }
}

}  // namespace
}  // namespace pulseline::control
