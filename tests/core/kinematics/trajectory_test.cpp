#include "core/kinematics/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/kinematics/primitives.hpp"
#include "tests/core/kinematics/vehicle_types.hpp"

namespace pulseline::kinematics {
namespace {

constexpr double kRounding = 1e-9;

struct Case {
    const char* name;
    plant::VehicleType type;
};

std::vector<Case> families() {
    return {{"steered", tang_platform()},
            {"mecanum", mecanum_platform()},
            {"differential", differential_vehicle()}};
}

/// Random motions of all modes of a type.
std::vector<MotionPlan> motions(const plant::VehicleType& type, int count) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> place(-20, 20);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    std::vector<MotionPlan> plans;
    for (int i = 0; i < count; ++i) {
        const Pose2 from{place(random), place(random), turn(random)};
        const Pose2 to{place(random), place(random), turn(random)};
        const Point2 beside = from * Point2{0, place(random)};
        for (const MotionMode mode : type.motion_modes) {
            const Pose2 goal =
                mode == MotionMode::kSelfRotation ? Pose2{from.x_m, from.y_m, to.heading_rad}
                : mode == MotionMode::kLateral    ? Pose2{beside.x_m, beside.y_m, to.heading_rad}
                                                  : to;
            if (auto plan = plan_motion(type, from, goal, mode)) plans.push_back(std::move(*plan));
        }
    }
    return plans;
}

TEST(Trajectory, KeepsWheelsAndBodyWithinTheirLimits) {
    for (const Case& family : families()) {
        SCOPED_TRACE(family.name);
        const auto& type = family.type;
        int looked = 0;
        for (const MotionPlan& plan : motions(type, 100)) {
            const auto trajectory = Trajectory::of(type, plan.segments);
            ASSERT_TRUE(trajectory);
            for (int k = 0; k <= 200; ++k, ++looked) {
                const auto now = trajectory->at(trajectory->duration_s() * k / 200);
                EXPECT_LE(std::abs(now.twist.turn_radps), type.max_turn_rate_radps + kRounding);
                for (const WheelMotion& wheel : now.wheels) {
                    EXPECT_LE(std::abs(wheel.speed_mps), type.max_speed_mps + kRounding);
                    EXPECT_LE(std::abs(wheel.angle_rad), kSteeringLimit_rad + kRounding);
                }
            }
        }
        EXPECT_GT(looked, 30'000);
    }
}

TEST(Trajectory, KnowsTheMostThatItsWheelsDo) {
    for (const Case& family : families()) {
        SCOPED_TRACE(family.name);
        for (const MotionPlan& plan : motions(family.type, 20)) {
            const auto trajectory = Trajectory::of(family.type, plan.segments);
            ASSERT_TRUE(trajectory);
            const WheelPeaks peaks = trajectory->wheel_peaks();
            WheelPeaks seen;
            for (int k = 0; k <= 2000; ++k) {
                const auto now = trajectory->at(trajectory->duration_s() * k / 2000);
                for (const WheelMotion& wheel : now.wheels) {
                    seen.speed_mps = std::max(seen.speed_mps, std::abs(wheel.speed_mps));
                    seen.steering_rad = std::max(seen.steering_rad, std::abs(wheel.angle_rad));
                }
            }
            EXPECT_NEAR(peaks.steering_rad, seen.steering_rad, kRounding);
            EXPECT_NEAR(peaks.speed_mps, seen.speed_mps, 0.01 * seen.speed_mps);
            EXPECT_LE(peaks.speed_mps, family.type.max_speed_mps + kRounding);
        }
    }
}

TEST(Trajectory, KeepsItsWheelsToTheLimitOfALane) {
    const auto type = tang_platform();
    const auto plan = plan_motion(type, {0, 0, 0}, {20, 0, 0}, MotionMode::kLinear);
    ASSERT_TRUE(plan) << plan.error().what;
    const std::vector<double> slow(plan->segments.size(), type.max_speed_mps / 4);

    const auto freely = Trajectory::of(type, plan->segments);
    const auto on_lane = Trajectory::of(type, plan->segments, slow);

    ASSERT_TRUE(freely && on_lane);
    EXPECT_NEAR(freely->wheel_peaks().speed_mps, type.max_speed_mps, kRounding);
    EXPECT_NEAR(on_lane->wheel_peaks().speed_mps, type.max_speed_mps / 4, kRounding);
    EXPECT_EQ(on_lane->wheel_peaks().steering_rad, 0);
}

TEST(Trajectory, TakesTheTimeThatThePlanSays) {
    for (const Case& family : families()) {
        SCOPED_TRACE(family.name);
        for (const MotionPlan& plan : motions(family.type, 50)) {
            const auto trajectory = Trajectory::of(family.type, plan.segments);
            ASSERT_TRUE(trajectory);
            EXPECT_NEAR(trajectory->duration_s(), plan.duration_s, 1e-6);
        }
    }
}

/// Law: what the wheels do, integrated over the time, drives the body to the end of the motion.
TEST(Trajectory, ItsWheelsDriveTheBodyToItsEnd) {
    constexpr int kSteps = 4000;
    for (const Case& family : families()) {
        SCOPED_TRACE(family.name);
        for (const MotionPlan& plan : motions(family.type, 5)) {
            const auto trajectory = Trajectory::of(family.type, plan.segments);
            ASSERT_TRUE(trajectory);
            const double step_s = trajectory->duration_s() / kSteps;
            Pose2 pose = plan.segments.front().start;
            for (int k = 0; k < kSteps; ++k) {
                const auto middle = trajectory->at((k + 0.5) * step_s);
                const BodyMotion body = body_of(family.type, middle.wheels);
                EXPECT_NEAR(body.slip_mps, 0, 1e-9);
                const Twist& v = body.twist;
                const double halfway = pose.heading_rad + v.turn_radps * step_s / 2;
                pose.x_m += step_s * (v.vx_mps * std::cos(halfway) - v.vy_mps * std::sin(halfway));
                pose.y_m += step_s * (v.vx_mps * std::sin(halfway) + v.vy_mps * std::cos(halfway));
                pose.heading_rad = wrap(pose.heading_rad + v.turn_radps * step_s);
            }
            const Pose2& end = plan.segments.back().end;
            EXPECT_LT(geometry::distance(pose.position(), end.position()), 0.01);
            EXPECT_LT(std::abs(wrap(pose.heading_rad - end.heading_rad)), 0.002);
        }
    }
}

TEST(Trajectory, NeverLetsASteeredWheelTurnFasterThanItCan) {
    const auto type = tang_platform();
    for (const MotionPlan& plan : motions(type, 20)) {
        const auto trajectory = Trajectory::of(type, plan.segments);
        ASSERT_TRUE(trajectory);
        const double step_s = trajectory->duration_s() / 1000;
        auto before = trajectory->at(0);
        for (int k = 1; k <= 1000; ++k) {
            const auto now = trajectory->at(k * step_s);
            for (std::size_t i = 0; i < now.wheels.size(); ++i) {
                EXPECT_LE(std::abs(now.wheels[i].angle_rad - before.wheels[i].angle_rad),
                          type.max_steering_rate_radps * step_s + kRounding);
            }
            before = now;
        }
    }
}

}  // namespace
}  // namespace pulseline::kinematics
