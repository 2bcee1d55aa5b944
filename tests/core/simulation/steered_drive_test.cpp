// Both drives steered by twists instead of along segments.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/machine/vehicle_motion.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::simulation {
namespace {

using kinematics::Twist;
using pulseline::testing::differential;
using pulseline::testing::mecanum;
using pulseline::testing::platform;

constexpr double kTick_s = 0.02;

std::unique_ptr<SimulatedDrive> make_drive(bool by_wheels, const plant::VehicleType& type,
                                           double time_factor = 1) {
    if (by_wheels) return std::make_unique<ServoDrive>(type, Pose2{}, 4, time_factor);
    return std::make_unique<VehicleMotion>(type, Pose2{}, 4, time_factor);
}

void run(SimulatedDrive& drive, double time_s) {
    for (double t = 0; t < time_s; t += kTick_s) drive.step(kTick_s);
}

Pose2 lost(const SimulatedDrive& drive) {
    return inverse(drive.believed_pose()) * drive.true_pose();
}

TEST(SteeredDrive, DrivesAsAskedUntilItIsToldToStop) {
    for (const auto& type : {platform(), mecanum(), differential()}) {
        for (const bool by_wheels : {false, true}) {
            const auto drive = make_drive(by_wheels, type);
            drive->steer({0.2, 0, 0.02});
            EXPECT_FALSE(drive->idle());
            run(*drive, 15);
            EXPECT_NEAR(drive->velocity_mps(), 0.2, 1e-9) << type.name;
            EXPECT_NEAR(drive->turn_rate_radps(), 0.02, 1e-9) << type.name;
            EXPECT_NEAR(drive->twist().vx_mps, 0.2, 0.01) << type.name;
            drive->steer({});
            EXPECT_FALSE(drive->idle());
            run(*drive, 8);

            EXPECT_TRUE(drive->idle()) << type.name;
            EXPECT_EQ(drive->segments_done(), 0u);
            EXPECT_FALSE(drive->stop_cause());
            const Pose2& at = drive->believed_pose();
            EXPECT_GT(at.x_m, 2) << type.name;
            // All of it on one circle, 10 m to the left.
            EXPECT_NEAR(std::hypot(at.x_m, at.y_m - 10), 10, 0.005) << type.name;
            EXPECT_NEAR(wrap(at.heading_rad - std::atan2(at.x_m, 10 - at.y_m)), 0, 1e-3);
            EXPECT_LT(norm(lost(*drive).position()), 0.01) << type.name;
        }
    }
}

TEST(SteeredDrive, FasterThanItsOwnTimeItDrivesTheSameWay) {
    for (const bool by_wheels : {false, true}) {
        const auto plain = make_drive(by_wheels, mecanum());
        const auto fast = make_drive(by_wheels, mecanum(), 4);
        plain->steer({0.1, 0.2, 0.05});
        fast->steer({0.4, 0.8, 0.2});
        run(*plain, 8);
        for (double t = 0; t < 2; t += kTick_s / 4) fast->step(kTick_s / 4);
        const Pose2 apart = inverse(plain->believed_pose()) * fast->believed_pose();
        EXPECT_LT(norm(apart.position()), 0.01);
        EXPECT_NEAR(apart.heading_rad, 0, 0.002);
    }
}

TEST(SteeredDrive, IsNeverFasterThanItsWheels) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, differential());
        drive->steer({5, 0, 0});
        run(*drive, 6);
        EXPECT_NEAR(drive->velocity_mps(), differential().max_speed_mps, 1e-9);
    }
}

TEST(SteeredDrive, HeldItStandsAndReleasedItGoesOn) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, mecanum());
        drive->steer({0.2, 0, 0});
        run(*drive, 3);
        drive->hold();
        run(*drive, 3);
        EXPECT_TRUE(drive->standing());
        EXPECT_FALSE(drive->idle());
        drive->release();
        run(*drive, 3);
        EXPECT_NEAR(drive->velocity_mps(), 0.2, 1e-9);
        drive->slow_to(0.5);
        run(*drive, 3);
        EXPECT_NEAR(drive->velocity_mps(), 0.1, 1e-9);
        drive->hold();
        run(*drive, 3);
        drive->clear();
        EXPECT_TRUE(drive->idle());
    }
}

TEST(SteeredDrive, GoesOnFromWhereItIsToldToBe) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, mecanum());
        drive->steer({0.2, 0, 0});
        run(*drive, 3);
        const Pose2 elsewhere{5, 3, kPi / 2};
        drive->set_believed(elsewhere);
        const Pose2 from = drive->true_pose();
        run(*drive, 3);
        EXPECT_FALSE(drive->stop_cause());
        const Pose2 believed = inverse(elsewhere) * drive->believed_pose();
        const Pose2 driven = inverse(from) * drive->true_pose();
        EXPECT_NEAR(believed.x_m, 0.6, 0.005);
        EXPECT_NEAR(believed.y_m, 0, 0.002);
        EXPECT_LT(distance(believed.position(), driven.position()), 0.003);
    }
}

TEST(SteeredDrive, SteersItsWheelsStandingBeforeANewDirection) {
    ServoDrive drive(platform(), {}, 4);
    drive.steer({0.2, 0, 0});
    run(drive, 6);
    drive.steer({0, 0.2, 0});
    bool stood = false;
    Pose2 turning;
    for (int i = 0; i < 1000 && drive.believed_pose().y_m < 0.5; ++i) {
        drive.step(kTick_s);
        if (drive.standing() && !stood) turning = drive.believed_pose();
        stood = stood || drive.standing();
    }
    EXPECT_TRUE(stood);
    EXPECT_NEAR(turning.y_m, 0, 0.002);
    EXPECT_NEAR(drive.believed_pose().x_m, turning.x_m, 0.005);
    EXPECT_GE(drive.believed_pose().y_m, 0.5);
    EXPECT_FALSE(drive.stop_cause());
}

TEST(SteeredDrive, TurnsWhileItGoesAside) {
    ServoDrive drive(platform(), {}, 4);
    const kinematics::Twist asked{0, 0.2, 0.03};
    drive.steer(asked);
    run(drive, 12);
    EXPECT_FALSE(drive.stop_cause());
    EXPECT_NEAR(drive.twist().vx_mps, 0, 0.01);
    EXPECT_NEAR(drive.twist().vy_mps, asked.vy_mps, 0.01);
    EXPECT_NEAR(drive.twist().turn_radps, asked.turn_radps, 0.003);
    EXPECT_LT(norm(lost(drive).position()), 0.02);
    drive.steer({0, 0.2, -0.03});
    run(drive, 12);
    EXPECT_FALSE(drive.stop_cause());
    EXPECT_NEAR(drive.twist().turn_radps, -0.03, 0.003);
}

TEST(SteeredDrive, TheStatisticalOneHasItsUsualErrorsAndNoneWithoutThem) {
    VehicleMotion exact(mecanum(), {}, 1, 1, simulation::testing::exact());
    exact.steer({0.2, 0.1, 0.02});
    run(exact, 10);
    EXPECT_LT(norm(lost(exact).position()), 1e-9);

    double sum_m = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        VehicleMotion motion(mecanum(), {}, seed);
        motion.steer({0.5, 0, 0});
        run(motion, 40);
        motion.steer({});
        run(motion, 4);
        sum_m += norm(lost(motion).position());
    }
    EXPECT_GT(sum_m / 60, 0.002);  // of 20 m
    EXPECT_LT(sum_m / 60, 0.010);
}

TEST(SteeredDrive, SegmentsFollowAsIfNothingHadBeen) {
    for (const bool by_wheels : {false, true}) {
        const auto drive = make_drive(by_wheels, mecanum());
        drive->steer({0, -0.2, 0});
        run(*drive, 3);
        drive->steer({});
        run(*drive, 3);
        ASSERT_TRUE(drive->idle());
        const Pose2 from = drive->believed_pose();
        drive->append(simulation::testing::straight(from, 2));
        run(*drive, 20);
        EXPECT_EQ(drive->segments_done(), 1u);
        EXPECT_LT(distance(drive->believed_pose().position(), from * geometry::Point2{2, 0}),
                  0.002);
    }
}

}  // namespace
}  // namespace pulseline::simulation
