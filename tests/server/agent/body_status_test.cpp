#include "server/agent/body_status.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/simulation/machine/servo_drive.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::agent {
namespace {

constexpr double kStep_s = 0.1;
constexpr double kWarm_c = 65;  // from here on people are shown it (web/src/features/vehicles)

/// The hottest wheel after so long on straight ways of 40 m, one behind the other.
double hottest_c(BodyStatus& body, simulation::ServoDrive& drive, double seconds) {
    for (double t = 0; t < seconds; t += kStep_s) {
        if (drive.idle()) drive.append(simulation::testing::straight(drive.believed_pose(), 40));
        drive.step(kStep_s);
        body.step(kStep_s);
    }
    vda5050::StateMessage state;
    body.write_state(state);
    EXPECT_FALSE(drive.stop_cause()) << drive.stop_cause()->code;
    return std::ranges::max(state.wheels, {}, &vda5050::WheelStatus::temperature_c).temperature_c;
}

TEST(BodyStatus, WheelsGetWarmFromDrivingAndHotFromABearingThatGrinds) {
    const auto type = pulseline::testing::platform();
    simulation::ServoDrive drive(type, {}, 3);
    BodyStatus body(drive);
    EXPECT_LT(hottest_c(body, drive, 900), kWarm_c);

    EXPECT_FALSE(body.seize_bearing("fifth"));
    ASSERT_TRUE(body.seize_bearing("front drive"));
    EXPECT_GT(hottest_c(body, drive, 900), kWarm_c);
}

}  // namespace
}  // namespace pulseline::agent
