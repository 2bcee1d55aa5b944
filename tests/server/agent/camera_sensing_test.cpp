#include "server/agent/camera_sensing.hpp"

#include <gtest/gtest.h>

#include "core/simulation/machine/vehicle_motion.hpp"
#include "core/simulation/world/world.hpp"
#include "tests/server/agent/small_hall.hpp"

namespace pulseline::agent {
namespace {

using testing::small_plant;
using testing::target_of;

TEST(CameraSensing, MeasuresTheTruePoseFromRenderedImages) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20.004, 9.995, 0.001}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, true, 3);
    const auto measured = sensing.measure(target_of(world.plant));
    ASSERT_TRUE(measured) << measured.error().what;
    EXPECT_EQ(measured->method, "dual_camera");
    EXPECT_LT(distance(measured->pose.position(), motion.true_pose().position()), 5e-4);
    EXPECT_NEAR(measured->pose.heading_rad, 0.001, 1e-4);
}

TEST(CameraSensing, PicturesOutliveTheReadingsOfAPlaceTheVehicleLeft) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20, 10, 0}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, true, 3);
    sensing.look();
    sensing.forget();
    EXPECT_TRUE(sensing.readings().empty());
    const auto pictures = sensing.pictures();
    ASSERT_EQ(pictures.size(), 2u);
    EXPECT_EQ(pictures[0].jpeg.substr(0, 2), "\xff\xd8");
}

TEST(CameraSensing, CoveredCodesFailWithTheReason) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20, 10, 0}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, false, 3);
    ASSERT_TRUE(sensing.measure(target_of(world.plant)));
    sensing.cover();
    const auto blind = sensing.measure(target_of(world.plant));
    ASSERT_FALSE(blind);
    EXPECT_EQ(blind.error().reason.code, "no_marker_in_view");
}

/// The camera knows of the codes what the order says and nothing of the world.
TEST(CameraSensing, ASurveyOfTheWrongKindOrSizeShows) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20, 10, 0}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, true, 3);
    ASSERT_TRUE(sensing.measure(target_of(world.plant)));
    for (const char* kind : {"apriltag", "landmark", "no kind"}) {
        auto target = target_of(world.plant);
        for (auto& marker : target.markers) marker.kind = kind;
        EXPECT_FALSE(sensing.measure(target)) << kind;
    }
    auto target = target_of(world.plant);
    for (auto& marker : target.markers) marker.size_m = 0.05;  // 0.06 m are printed
    EXPECT_FALSE(sensing.measure(target));
}

}  // namespace
}  // namespace pulseline::agent
