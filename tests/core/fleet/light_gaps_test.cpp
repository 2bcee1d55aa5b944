#include "core/fleet/tables/light_gaps.hpp"

#include <gtest/gtest.h>

#include "core/fleet/tables/layout.hpp"
#include "tests/core/fleet/traffic_halls.hpp"

namespace pulseline::fleet::testing {
namespace {

/// One lane of 40 m along x, driven by vehicles with receivers, between two transmitters on its
/// left.
plant::Plant lit_lane() {
    plant::Plant plant =
        plant_of({{"west", 20, 40, 1}, {"east", 60, 40, 2}}, {{"west", "east"}}, 1);
    auto& type = plant.vehicle_types.front();
    type.cameras.clear();
    type.receivers = {{"front", {0.4, 0}, 0.6}, {"rear", {-0.4, 0}, 0.6}};
    plant.markers.clear();
    for (const auto& [id, x_m] : {std::pair{"tx-1", 25.0}, std::pair{"tx-2", 55.0}}) {
        plant::Transmitter transmitter;
        transmitter.id = plant::TransmitterId(id);
        transmitter.hall = plant.halls.front().id;
        transmitter.position = {x_m, 50};
        plant.transmitters.push_back(transmitter);
    }
    return plant;
}

std::vector<Reason> gaps(const plant::Plant& plant) {
    std::vector<Reason> found;
    for (const auto& reason : check_layout(plant)) {
        if (reason.code == kLightGap) found.push_back(reason);
    }
    return found;
}

std::int64_t count(const Reason& reason) {
    for (const auto& param : reason.params) {
        if (param.name == "count") return std::get<std::int64_t>(param.value);
    }
    return -1;
}

TEST(LightGaps, ALaneInTheLightHasNone) { EXPECT_TRUE(gaps(lit_lane()).empty()); }

TEST(LightGaps, WhatStandsInTheLightsWayIsFoundAndWhatIsTooFar) {
    plant::Plant plant = lit_lane();
    plant::Area shelf;
    shelf.id = plant::AreaId("shelf");
    shelf.kind = plant::AreaKind::kObstacle;
    shelf.hall = plant.halls.front().id;
    shelf.outline = {{30, 44}, {34, 44}, {34, 45}, {30, 45}};
    plant.areas.push_back(shelf);
    const auto shaded = gaps(plant);
    ASSERT_EQ(shaded.size(), 1U);
    EXPECT_GT(count(shaded[0]), 3);

    plant.areas.pop_back();
    for (auto& transmitter : plant.transmitters) transmitter.range_m = 20;
    const auto far = gaps(plant);
    ASSERT_EQ(far.size(), 1U);
    EXPECT_GT(count(far[0]), 20);
}

TEST(LightGaps, VehiclesWithCamerasOrWithoutReceiversHaveNone) {
    plant::Plant plant = lit_lane();
    plant.transmitters.pop_back();
    EXPECT_EQ(gaps(plant).size(), 1U);
    plant::Plant seeing = plant;
    seeing.vehicle_types.front().cameras.emplace_back();
    EXPECT_TRUE(gaps(seeing).empty());
    plant.vehicle_types.front().receivers.clear();
    EXPECT_TRUE(gaps(plant).empty());
}

}  // namespace
}  // namespace pulseline::fleet::testing
