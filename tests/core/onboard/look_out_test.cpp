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
    plant::Vehicle vehicle;
    vehicle.type = type.id;
    simulation::ServoDrive drive(type, {20, 30, 0}, 3);
    simulation::SimulatedScanners scanners(world, plant::HallId("hall"), type, drive.true_pose(),
                                           5);
    LookOut look_out(scanners, vehicle, drive);
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

/// Told to go slowly it does, however free the floor is; then it drives as fast as before.
TEST(LookOut, GoesNoFasterThanItIsTold) {
    const auto type = differential();
    const auto world = testing::world_of(type);
    plant::Vehicle vehicle;
    vehicle.type = type.id;
    simulation::ServoDrive drive(type, {20, 30, 0}, 3);
    simulation::SimulatedScanners scanners(world, plant::HallId("hall"), type, drive.true_pose(),
                                           5);
    LookOut look_out(scanners, vehicle, drive);
    double fastest_mps = 0;
    const auto run = [&](double seconds) {
        fastest_mps = 0;
        for (double t = 0; t < seconds; t += testing::kStep_s) {
            look_out.step(testing::kStep_s);
            drive.step(testing::kStep_s);
            if (t > 4) fastest_mps = std::max(fastest_mps, drive.velocity_mps());
        }
    };
    drive.append(simulation::testing::straight({20, 30, 0}, 25));
    look_out.keep_below(0.3 / type.max_speed_mps);
    run(10);
    EXPECT_NEAR(fastest_mps, 0.3, 0.05);
    look_out.keep_below(1);
    run(8);
    EXPECT_GT(fastest_mps, 0.6);
    EXPECT_FALSE(look_out.barred());
}

}  // namespace
}  // namespace pulseline::onboard
