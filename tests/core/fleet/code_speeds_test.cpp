#include "core/fleet/tables/code_speeds.hpp"

#include <gtest/gtest.h>

#include "core/fleet/tables/layout.hpp"
#include "core/localisation/reading_speed.hpp"
#include "tests/core/fleet/traffic_halls.hpp"

namespace pulseline::fleet::testing {
namespace {

plant::Camera slow_camera() {
    plant::Camera camera;
    camera.frame_rate_hz = 30;
    return camera;
}

/// Two stations on a lane with a code of 60 mm between, for vehicles with one camera.
plant::Plant lane_with_a_code(double max_speed_mps) {
    plant::Plant plant =
        plant_of({{"west", 20, 40, 1}, {"east", 28, 40, 2}}, {{"west", "east"}}, 1);
    plant.vehicle_types.front().cameras = {slow_camera()};
    plant.vehicle_types.front().max_speed_mps = max_speed_mps;
    plant::Marker marker;
    marker.id = plant::MarkerId("between");
    marker.payload = "between";
    marker.hall = plant.halls.front().id;
    marker.pose = {24, 40, 0};
    plant.markers = {marker};
    return plant;
}

std::vector<Reason> too_fast(const plant::Plant& plant) {
    std::vector<Reason> found;
    for (const auto& reason : check_layout(plant)) {
        if (reason.code == kCodesTooFast) found.push_back(reason);
    }
    return found;
}

TEST(CodeSpeeds, ATypeThatReadsNothingAtItsOwnSpeedIsNamedWithBothSpeeds) {
    const auto plant = lane_with_a_code(3);
    const auto found = too_fast(plant);
    ASSERT_EQ(found.size(), 1U);
    const auto& params = found[0].params;
    EXPECT_EQ(std::get<std::string>(params[0].value), plant.vehicle_types.front().id.str());
    EXPECT_EQ(std::get<double>(params[1].value),
              localisation::reading_speed_mps(slow_camera(), 0.06));
    EXPECT_NEAR(std::get<double>(params[1].value), 2.09, 0.005);
    EXPECT_EQ(std::get<double>(params[2].value), 3);
}

TEST(CodeSpeeds, OneCodeThatItReadsOrNoneAtAllIsNoFault) {
    EXPECT_TRUE(too_fast(lane_with_a_code(2)).empty());
    auto plant = lane_with_a_code(3);
    plant.markers.push_back(plant.markers.front());
    plant.markers.back().id = plant::MarkerId("small");
    plant.markers.back().payload = "small";
    plant.markers.back().size_m = 0.02;
    EXPECT_TRUE(too_fast(plant).empty());
    plant.markers.clear();
    EXPECT_TRUE(too_fast(plant).empty()) << "there is nothing to read";
    plant = lane_with_a_code(3);
    plant.vehicle_types.front().cameras.clear();
    EXPECT_TRUE(too_fast(plant).empty());
}

}  // namespace
}  // namespace pulseline::fleet::testing
