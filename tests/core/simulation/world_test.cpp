#include "core/simulation/world/world.hpp"

#include <gtest/gtest.h>

namespace pulseline::simulation {
namespace {

plant::Plant small_plant() {
    plant::Plant plant;
    plant::Marker marker;
    marker.id = plant::MarkerId("m1");
    marker.payload = "ST01-F";
    marker.pose = {10, 20, 1};
    plant.markers.push_back(marker);
    plant::Station station;
    station.id = plant::StationId("st01");
    station.pose = {12, 20, 0};
    plant.stations.push_back(station);
    return plant;
}

TEST(World, MarkersLieNearTheirSurvey) {
    double sum2 = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const auto world = make_world(small_plant(), seed);
        const double off = world.markers.front().pose.x_m - 10;
        sum2 += off * off;
    }
    const double sigma =
        std::hypot(1e-4, localisation::MarkerErrors{}.print_m);  // and the survey's
    EXPECT_NEAR(std::sqrt(sum2 / 500), sigma, 0.15 * sigma);
}

TEST(World, SameSeedSameWorld) {
    const auto a = make_world(small_plant(), 3);
    EXPECT_EQ(a.markers.front().pose, make_world(small_plant(), 3).markers.front().pose);
    EXPECT_NE(a.markers.front().pose, make_world(small_plant(), 4).markers.front().pose);
}

TEST(World, VehiclesArePlacedNearHome) {
    const auto world = make_world(small_plant(), 1);
    plant::Vehicle vehicle;
    vehicle.home = plant::StationId("st01");
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto pose = placed_pose(world, vehicle, seed);
        ASSERT_TRUE(pose);
        EXPECT_LE(std::abs(pose->x_m - 12), 0.008);
        EXPECT_LE(std::abs(pose->heading_rad), radians(0.1));
    }
    vehicle.home = plant::StationId("nowhere");
    const auto lost = placed_pose(world, vehicle, 1);
    ASSERT_FALSE(lost);
    EXPECT_EQ(lost.error().reason.code, "no_home_station");
}

}  // namespace
}  // namespace pulseline::simulation
