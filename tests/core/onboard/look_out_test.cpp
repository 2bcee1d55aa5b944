#include "core/onboard/look_out.hpp"

#include <gtest/gtest.h>

#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/onboard/going_round_rig.hpp"

namespace pulseline::onboard {
namespace {

using pulseline::testing::differential;

TEST(LookOut, StopsBeforeAnotherVehicleAndGoesOnWhenThatHasLeft) {
    const auto type = differential();
    const auto world = testing::world_of(type);
    simulation::ServoDrive drive(type, {20, 30, 0}, 3);
    simulation::SimulatedScanners scanners(world, plant::HallId("hall"), type, drive.true_pose(),
                                           5);
    LookOut look_out(scanners, false, drive);
    bool stands_there = true;
    const geometry::Polygon other = geometry::transformed({30, 30, 0}, type.footprint);
    int asked = 0;
    scanners.see([&](geometry::Point2 from, std::vector<geometry::Polygon>& seen) {
        ++asked;
        EXPECT_EQ(from, drive.true_pose().position());
        if (stands_there) seen.push_back(other);
    });
    const auto run = [&](double seconds) {
        for (double t = 0; t < seconds; t += testing::kStep_s) {
            look_out.step(testing::kStep_s);
            drive.step(testing::kStep_s);
        }
    };

    drive.append(simulation::testing::straight({20, 30, 0}, 15));
    run(60);
    EXPECT_TRUE(look_out.barred());
    EXPECT_TRUE(drive.standing());
    EXPECT_GT(drive.true_pose().x_m, 24);
    const auto body = geometry::transformed(drive.true_pose(), type.footprint);
    EXPECT_LT(geometry::bounding_box(body).max.x_m, geometry::bounding_box(other).min.x_m);
    vda5050::StateMessage state;
    look_out.write_state(state);
    EXPECT_TRUE(state.field_violation);

    stands_there = false;
    run(60);
    EXPECT_FALSE(look_out.barred());
    EXPECT_NEAR(drive.believed_pose().x_m, 35, 0.01);
    EXPECT_GT(asked, 20);
}

TEST(LookOut, WithAWindowCoveredItStaysUntilThatIsClean) {
    const auto type = differential();
    const auto world = testing::world_of(type);
    simulation::ServoDrive drive(type, {20, 30, 0}, 3);
    simulation::SimulatedScanners scanners(world, plant::HallId("hall"), type, drive.true_pose(),
                                           5);
    LookOut look_out(scanners, false, drive);
    const auto run = [&](double seconds) {
        for (double t = 0; t < seconds; t += testing::kStep_s) {
            look_out.step(testing::kStep_s);
            drive.step(testing::kStep_s);
        }
    };
    drive.append(simulation::testing::straight({20, 30, 0}, 15));
    run(5);
    ASSERT_FALSE(drive.standing());
    const double covered_at_m = drive.true_pose().x_m;
    scanners.cover();
    run(10);
    EXPECT_TRUE(look_out.barred());
    EXPECT_TRUE(drive.standing());
    const double braking_m = type.max_speed_mps * type.max_speed_mps / (2 * type.max_accel_mps2);
    EXPECT_LT(drive.true_pose().x_m, covered_at_m + braking_m + 0.5);
    vda5050::StateMessage state;
    look_out.write_state(state);
    ASSERT_EQ(state.errors.size(), 1u);
    EXPECT_EQ(state.errors.front().type, LookOut::kBlind);

    scanners.clean();
    run(60);
    EXPECT_NEAR(drive.believed_pose().x_m, 35, 0.01);
    state = {};
    look_out.write_state(state);
    EXPECT_TRUE(state.errors.empty());
}

}  // namespace
}  // namespace pulseline::onboard
