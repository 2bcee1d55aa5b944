#include "core/simulation/machine/drive_heat.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::simulation {
namespace {

class DriveHeatTest : public ::testing::Test {
protected:
    void drive(double share, double seconds) {
        std::vector<kinematics::WheelMotion> rolling(type.wheels.size());
        for (auto& wheel : rolling) wheel.speed_mps = -share * type.max_speed_mps;
        for (double t = 0; t < seconds; t += 0.1) heat.step(0.1, rolling);
    }

    plant::VehicleType type = pulseline::testing::platform();
    DriveHeat heat{type};
};

TEST_F(DriveHeatTest, ADriveGetsWarmByDrivingAndNeverReachesItsLimits) {
    EXPECT_EQ(heat.temperature_c(4), 22);
    drive(1, 7200);
    EXPECT_GT(heat.temperature_c(4), 39);
    EXPECT_LT(heat.temperature_c(4), type.drive_temperatures.warm_c);
}

TEST_F(DriveHeatTest, OneThatGrindsSwitchesItselfOffAndGoesAgainWhenItIsNoMoreWarm) {
    EXPECT_FALSE(heat.seize_bearing("fifth"));
    ASSERT_TRUE(heat.seize_bearing(type.wheels[4].name));
    drive(1, 60);
    EXPECT_GT(heat.temperature_c(4), heat.temperature_c(5) + 20);
    EXPECT_FALSE(heat.is_off(4));
    drive(1, 600);
    EXPECT_GE(heat.temperature_c(4), type.drive_temperatures.hot_c);
    EXPECT_TRUE(heat.is_off(4));
    EXPECT_FALSE(heat.is_off(5));
    drive(0, 30);
    EXPECT_LT(heat.temperature_c(4), type.drive_temperatures.hot_c + 20);
    EXPECT_TRUE(heat.is_off(4)) << "it is still warm";
    drive(0, 300);
    EXPECT_LT(heat.temperature_c(4), type.drive_temperatures.warm_c);
    EXPECT_FALSE(heat.is_off(4));
}

}  // namespace
}  // namespace pulseline::simulation
