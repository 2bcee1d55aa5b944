#include "core/planning/grid/search_choice.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/planning/grid/grid_search.hpp"

namespace pulseline::planning {
namespace {

plant::OccupancyGrid floor_of(int size) {
    plant::OccupancyGrid grid;
    grid.width = grid.height = size;
    grid.resolution_m = 1;
    grid.occupied.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
    return grid;
}

plant::OccupancyGrid strewn(int size, unsigned percent) {
    auto grid = floor_of(size);
    std::mt19937 random(41);
    for (auto& cell : grid.occupied) cell = random() % 100 < percent;
    grid.occupied.front() = grid.occupied.back() = 0;
    return grid;
}

plant::OccupancyGrid halls(int size) {
    auto grid = floor_of(size);
    for (int wall = 31; wall < size; wall += 32) {
        for (int p = 0; p < size; ++p) {
            if (p % 32 == 7) continue;  // doors
            grid.occupied[static_cast<std::size_t>(wall * size + p)] = 1;
            grid.occupied[static_cast<std::size_t>(p * size + wall)] = 1;
        }
    }
    return grid;
}

Algorithm answered_by(const GridMap& map) {
    GridRoute route;
    GridSearch().run(map, {{0, 0}, {map.width() - 1, map.height() - 1}}, Algorithm::kTurnJump,
                     route);
    return route.algorithm;
}

TEST(SearchChoice, JumpsWhereWallsAreLong) {
    for (const auto& grid : {floor_of(192), halls(192)}) {
        const GridMap map(point_layers(grid));

        EXPECT_TRUE(map.jumps_pay());
        EXPECT_EQ(answered_by(map), Algorithm::kTurnJump);
    }
}

TEST(SearchChoice, StepsFromCellToCellOnFloorsStrewnWithObstacles) {
    for (const unsigned percent : {10u, 20u, 30u}) {
        const GridMap map(point_layers(strewn(192, percent)));

        EXPECT_FALSE(map.jumps_pay()) << percent;
        EXPECT_EQ(answered_by(map), Algorithm::kBucket) << percent;
    }
}

TEST(SearchChoice, IsTheSameEveryTimeAndKeptByEdits) {
    const auto grid = strewn(192, 15);
    GridMap map(point_layers(grid));
    const GridMap again(point_layers(grid));

    EXPECT_EQ(map.jumps_pay(), again.jumps_pay());
    map.set_blocked({5, 5}, true);
    EXPECT_EQ(map.jumps_pay(), again.jumps_pay());
}

TEST(SearchChoice, EveryFloorHasAnAnswer) {
    auto blocked = floor_of(128);
    blocked.occupied.assign(blocked.occupied.size(), 1);
    auto one_free = blocked;
    one_free.occupied[77] = 0;

    EXPECT_TRUE(GridMap(point_layers(blocked)).jumps_pay());
    EXPECT_TRUE(GridMap(point_layers(one_free)).jumps_pay());
}

}  // namespace
}  // namespace pulseline::planning
