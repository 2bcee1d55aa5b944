#include "core/planning/room/disc_distances.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pulseline::planning {
namespace {

/// 40 m x 20 m with a wall at x = 20 that leaves a gap of `gap_m` above y = 2.
plant::Plant walled_hall(double gap_m) {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{0, 0}, {40, 0}, {40, 20}, {0, 20}};
    plant.halls.push_back(hall);
    plant.areas.push_back({plant::AreaId("low"),
                           plant::AreaKind::kObstacle,
                           "low",
                           hall.id,
                           {{19.8, 0}, {20.2, 0}, {20.2, 2}, {19.8, 2}},
                           {}});
    plant.areas.push_back({plant::AreaId("high"),
                           plant::AreaKind::kObstacle,
                           "high",
                           hall.id,
                           {{19.8, 2 + gap_m}, {20.2, 2 + gap_m}, {20.2, 20}, {19.8, 20}},
                           {}});
    return plant;
}

DiscDistances distances(const plant::Plant& plant) {
    const FloorField field(plant, plant.halls.front(), 2.5);
    return {field, 1.0, {35, 15}};
}

TEST(DiscDistances, LeadRoundWhatStandsInTheWay) {
    const DiscDistances left = distances(walled_hall(6));
    // Over the gap's middle it is 34.0 m from there, straight through the wall 30 m.
    const double round_m = left.from({5, 15});
    EXPECT_GT(round_m, 31);
    EXPECT_LT(round_m, 1.09 * 36);
    EXPECT_NEAR(left.from({30, 15}), 5, 0.6);
}

TEST(DiscDistances, AreInfiniteOnlyWhereTheDiscCannotPass) {
    for (const double gap_m : {2.0, 2.05, 2.4, 3.1}) {  // the disc is 2 m wide
        EXPECT_TRUE(std::isfinite(distances(walled_hall(gap_m)).from({5, 15}))) << gap_m;
    }
    EXPECT_FALSE(std::isfinite(distances(walled_hall(0.8)).from({5, 15})));
    EXPECT_FALSE(std::isfinite(distances(walled_hall(6)).from({-1, 15})));
}

TEST(DiscDistances, PreferADetourToAGapThatMayBeTooNarrow) {
    plant::Plant plant = walled_hall(2.0);
    plant.areas[1].outline = {{19.8, 4}, {20.2, 4}, {20.2, 15}, {19.8, 15}};  // open above y = 15
    const DiscDistances left = distances(plant);
    EXPECT_LT(left.from({5, 3}), 50);
    EXPECT_GT(left.from({5, 3}), 30 + 2);  // not straight through
}

}  // namespace
}  // namespace pulseline::planning
