#include "core/fleet/tables/code_gaps.hpp"

#include <gtest/gtest.h>

#include <variant>

#include "core/fleet/tables/layout.hpp"
#include "tests/core/fleet/traffic_halls.hpp"

namespace pulseline::fleet::testing {
namespace {

/// One lane of 40 m along x from the first spot, driven by vehicles with one camera below the
/// middle; a code at each end.
plant::Plant long_lane() {
    plant::Plant plant =
        plant_of({{"west", 20, 40, 1}, {"east", 60, 40, 2}}, {{"west", "east"}}, 1);
    plant::Camera camera;
    camera.name = "below";
    plant.vehicle_types.front().cameras = {camera};
    plant.markers.clear();
    return plant;
}

void lay(plant::Plant& plant, double x_m, double y_m) {
    plant::Marker marker;
    marker.id = plant::MarkerId("code-" + std::to_string(plant.markers.size()));
    marker.kind = plant::MarkerKind::kAprilTag;
    marker.payload = std::to_string(plant.markers.size());
    marker.size_m = 0.05;
    marker.hall = plant.halls.front().id;
    marker.pose = {x_m, y_m, 0};
    plant.markers.push_back(marker);
}

std::vector<Reason> gaps(const plant::Plant& plant) {
    std::vector<Reason> found;
    for (const auto& reason : check_layout(plant)) {
        if (reason.code == kCodeGap) found.push_back(reason);
    }
    return found;
}

double number(const Reason& reason, const std::string& name) {
    for (const auto& param : reason.params) {
        const auto* value = std::get_if<double>(&param.value);
        if (param.name == name && value) return *value;
    }
    return -1;
}

TEST(CodeGaps, NamesTheWayAndWhereACodeHelps) {
    plant::Plant plant = long_lane();
    lay(plant, 20, 40);
    lay(plant, 60, 40);
    const auto found = gaps(plant);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(number(found[0], "blind_m"), 40 - 0.09, 0.1) << "half the view at both ends";
    EXPECT_GT(number(found[0], "at_most_m"), 9);
    EXPECT_NEAR(number(found[0], "at_x_m"), 40, 2.1);
    EXPECT_NEAR(number(found[0], "at_y_m"), 40, 0.1);
}

TEST(CodeGaps, AreClosedByCodesBelowTheCameras) {
    plant::Plant plant = long_lane();
    for (const double x_m : {20, 29, 38, 47, 56, 60}) lay(plant, x_m, 40);
    EXPECT_TRUE(gaps(plant).empty());
    plant.markers[2].pose.y_m += 0.2;  // no camera sees it there
    const auto found = gaps(plant);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(number(found[0], "blind_m"), 18 - 0.09, 0.1);
}

TEST(CodeGaps, AVehicleThatPassesNoCodeAtAllHasNoFigure) {
    plant::Plant plant = long_lane();
    lay(plant, 100, 10);
    const auto found = gaps(plant);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(number(found[0], "blind_m"), -1);
}

TEST(CodeGaps, AreNoneOfVehiclesWithoutCamerasNorOfPlantsWithoutCodes) {
    plant::Plant plant = long_lane();
    EXPECT_TRUE(gaps(plant).empty());
    lay(plant, 20, 40);
    EXPECT_FALSE(gaps(plant).empty());
    plant.vehicle_types.front().cameras.clear();
    EXPECT_TRUE(gaps(plant).empty());
}

}  // namespace
}  // namespace pulseline::fleet::testing
