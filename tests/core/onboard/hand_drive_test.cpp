#include "core/onboard/hand_drive.hpp"

#include <gtest/gtest.h>

#include "core/simulation/machine/vehicle_motion.hpp"
#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;

constexpr double kTick_s = 0.02;

struct Held {
    explicit Held(const plant::VehicleType& type) : motion(type, {}, 3), hand(motion) {
        hand.take();
    }
    /// Asks for it all the time, as a held switch does.
    void drive(const kinematics::Twist& wanted, double time_s) {
        for (double t = 0; t < time_s; t += kTick_s) {
            ASSERT_TRUE(hand.command(wanted));
            tick();
        }
    }
    void wait(double time_s) {
        for (double t = 0; t < time_s; t += kTick_s) tick();
    }
    void tick() {
        const Pose2 before = motion.believed_pose();
        hand.step(kTick_s);
        motion.step(kTick_s);
        fastest_mps = std::max(
            fastest_mps, distance(before.position(), motion.believed_pose().position()) / kTick_s);
    }

    VehicleMotion motion;
    HandDrive hand;
    double fastest_mps = 0;
};

TEST(HandDrive, MovesAsAskedAndNoFasterThanAWalk) {
    Held held(pulseline::testing::differential());
    held.drive({1.5, 0, 0}, 4);
    EXPECT_GT(held.motion.believed_pose().x_m, 0.8);
    EXPECT_NEAR(held.motion.believed_pose().y_m, 0, 1e-6);
    EXPECT_LE(held.fastest_mps, HandDrive::kFastest_mps + 1e-6);
    held.drive({-0.2, 0, 0}, 4);
    EXPECT_LT(held.motion.velocity_mps(), 0);
}

TEST(HandDrive, BrakesWhenThePersonLetsGo) {
    Held held(pulseline::testing::differential());
    held.drive({0.3, 0, 0}, 3);
    held.wait(HandDrive::kLetGo_s + 1.0);
    EXPECT_TRUE(held.hand.standing());
    const Pose2 stood = held.motion.believed_pose();
    held.wait(5);
    EXPECT_EQ(held.motion.believed_pose(), stood);
}

TEST(HandDrive, TurnsAndGoesAside) {
    Held held(pulseline::testing::mecanum());
    held.drive({0, 0.2, 0}, 4);
    EXPECT_GT(held.motion.believed_pose().y_m, 0.4);
    held.wait(3);
    held.drive({0, 0, -0.1}, 4);
    EXPECT_LT(held.motion.believed_pose().heading_rad, -0.2);
    held.wait(3);
    held.drive({0.2, 0, 0.1}, 4);  // an arc
    EXPECT_GT(held.motion.turn_rate_radps(), 0);
    EXPECT_GT(held.motion.velocity_mps(), 0);
}

TEST(HandDrive, TurnsWhileItGoesAsideOnRollersAndOnSteeredWheels) {
    for (const auto& type : {pulseline::testing::mecanum(), pulseline::testing::platform()}) {
        const kinematics::Twist asked{0.05, 0.2, type.wheels[0].steered ? 0.03 : 0.08};
        Held held(type);
        held.drive(asked, 5);
        const kinematics::Twist twist = held.motion.twist();
        EXPECT_NEAR(twist.vx_mps, asked.vx_mps, 1e-6);
        EXPECT_NEAR(twist.vy_mps, asked.vy_mps, 1e-6);
        EXPECT_NEAR(twist.turn_radps, asked.turn_radps, 1e-6);
    }
}

TEST(HandDrive, TakesAVehicleOffItsWayAndGivesItBackIdle) {
    Held held(pulseline::testing::differential());
    held.hand.give_back();
    kinematics::Segment way;
    way.end = {20, 0, 0};
    way.length_m = 20;
    held.motion.append(way);
    for (int i = 0; i < 200; ++i) held.motion.step(kTick_s);
    held.motion.slow_to(0.1);  // something is beside it
    held.hand.take();
    EXPECT_FALSE(held.hand.standing());
    held.drive({-0.2, 0, 0}, 8);
    EXPECT_NEAR(held.motion.velocity_mps(), -0.2, 1e-9);
    held.drive({0.2, 0, 0}, 0.2);  // braking, not jumping
    EXPECT_LT(held.motion.velocity_mps(), 0);
    held.wait(3);
    held.hand.give_back();
    EXPECT_TRUE(held.motion.idle());
    EXPECT_EQ(held.motion.segments_done(), 0u);
}

TEST(HandDrive, RefusesWhatTheWheelsCannotDo) {
    Held held(pulseline::testing::differential());
    held.drive({0.3, 0, 0}, 2);
    const Status refused = held.hand.command({0, 0.2, 0});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "cannot_move_so");
    held.wait(2);
    EXPECT_TRUE(held.hand.standing());
}

}  // namespace
}  // namespace pulseline::onboard
