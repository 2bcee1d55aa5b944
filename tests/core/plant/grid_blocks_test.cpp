#include "core/plant/grid_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pulseline::plant {
namespace {

using geometry::Point2;

/// 12 m x 8 m, with a ring of wall cells round it, as the demo plants' grids have.
Hall hall_of_cells(double resolution_m) {
    Hall hall;
    hall.outline = {{0, 0}, {12, 0}, {12, 8}, {0, 8}};
    hall.grid.resolution_m = resolution_m;
    hall.grid.origin = {-resolution_m, -resolution_m};
    hall.grid.width = static_cast<int>(12 / resolution_m) + 2;
    hall.grid.height = static_cast<int>(8 / resolution_m) + 2;
    hall.grid.occupied.assign(static_cast<std::size_t>(hall.grid.width) * hall.grid.height, 0);
    return hall;
}

void occupy(Hall& hall, int column, int row) {
    hall.grid.occupied[static_cast<std::size_t>(row) * hall.grid.width + column] = 1;
}

void build_ring(Hall& hall) {
    for (int column = 0; column < hall.grid.width; ++column) {
        occupy(hall, column, 0);
        occupy(hall, column, hall.grid.height - 1);
    }
    for (int row = 0; row < hall.grid.height; ++row) {
        occupy(hall, 0, row);
        occupy(hall, hall.grid.width - 1, row);
    }
}

TEST(GridBlocks, AColumnIsOneRectangleAndTheWallIsNone) {
    Hall hall = hall_of_cells(0.5);
    build_ring(hall);
    for (int row = 5; row < 8; ++row) {
        for (int column = 9; column < 11; ++column) occupy(hall, column, row);
    }
    const auto blocks = grid_blocks(hall);
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_EQ(blocks.front(), (geometry::Polygon{{4, 2}, {5, 2}, {5, 3.5}, {4, 3.5}}));
}

TEST(GridBlocks, AColumnAtTheWallStands) {
    Hall hall = hall_of_cells(0.5);
    build_ring(hall);
    for (int column = 1; column < 3; ++column) occupy(hall, column, 6);
    bool stands = false;
    for (const auto& block : grid_blocks(hall)) {
        stands |= geometry::contains(block, {0.75, 2.75});
    }
    EXPECT_TRUE(stands);
}

TEST(GridBlocks, HallsWithoutAGridHaveNone) {
    Hall hall = hall_of_cells(0.5);
    hall.grid = {};
    EXPECT_TRUE(grid_blocks(hall).empty());
    EXPECT_FALSE(crosses_grid(hall, {1, 1}, {11, 7}));
}

TEST(GridBlocks, TheyCoverEachOccupiedCellOnceAndNoOther) {
    std::mt19937_64 random(3);
    std::bernoulli_distribution occupied(0.4);
    for (int run = 0; run < 20; ++run) {
        Hall hall = hall_of_cells(0.5);
        for (int row = 1; row + 1 < hall.grid.height; ++row) {
            for (int column = 1; column + 1 < hall.grid.width; ++column) {
                if (occupied(random)) occupy(hall, column, row);
            }
        }
        const auto blocks = grid_blocks(hall);
        for (int row = 1; row + 1 < hall.grid.height; ++row) {
            for (int column = 1; column + 1 < hall.grid.width; ++column) {
                const Point2 middle{hall.grid.origin.x_m + (column + 0.5) * 0.5,
                                    hall.grid.origin.y_m + (row + 0.5) * 0.5};
                const auto over = std::ranges::count_if(
                    blocks, [&](const auto& block) { return geometry::contains(block, middle); });
                EXPECT_EQ(over, hall.grid.is_occupied(column, row) ? 1 : 0);
            }
        }
    }
}

TEST(GridBlocks, AWayCrossesWhatStandsOnIt) {
    Hall hall = hall_of_cells(0.1);
    build_ring(hall);
    for (int row = 30; row < 37; ++row) {
        for (int column = 60; column < 67; ++column) occupy(hall, column, row);  // from (5.9, 2.9)
    }
    EXPECT_TRUE(crosses_grid(hall, {1, 3.2}, {11, 3.2}));
    EXPECT_TRUE(crosses_grid(hall, {11, 4.2}, {1, 2.2}));
    EXPECT_FALSE(crosses_grid(hall, {1, 2.8}, {11, 2.8}));
    EXPECT_FALSE(crosses_grid(hall, {1, 3.2}, {5.8, 3.2}));
    EXPECT_FALSE(crosses_grid(hall, {3, 3}, {3, 3}));
    EXPECT_FALSE(crosses_grid(hall, {0.05, 0.05}, {11.95, 0.05})) << "along the wall";
}

}  // namespace
}  // namespace pulseline::plant
