#include "core/planning/grid/grid_blocking.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/core/planning/grid_judge.hpp"

namespace pulseline::planning {
namespace {

void clear(GridLayers& layers, Cell cell) {
    for (auto& layer : layers.blocked) layer.set(cell, false);
    layers.no_turn.set(cell, false);
}

bool reachable(const GridLayers& layers, const GridRequest& request) {
    return judge(layers, request) != kUnreached;
}

TEST(BlockingCells, NameTheThinnestPlaceOfAWall) {
    auto grid = grid_of(7, 5);
    for (int row = 0; row < 5; ++row) {
        for (const int col : {2, 3}) grid.occupied[static_cast<std::size_t>(row * 7 + col)] = 1;
    }
    grid.occupied[3 * 7 + 2] = 0;  // here the wall is one cell thick
    const GridMap map(point_layers(grid));

    const auto cells = blocking_cells(map, {{0, 0}, {6, 0}});

    ASSERT_TRUE(cells);
    ASSERT_EQ(cells->size(), 1u);
    EXPECT_EQ(cells->front().cell, (Cell{3, 3}));
    EXPECT_FALSE(cells->front().turning);
}

TEST(BlockingCells, ClearingThemIsEnoughAndFewerAreNot) {
    std::mt19937_64 random(17);
    int sets = 0;
    for (int i = 0; i < 400; ++i) {
        auto grid = grid_of(2 + static_cast<int>(random() % 6), 2 + static_cast<int>(random() % 6));
        for (auto& cell : grid.occupied) cell = random() % 2 == 0;
        GridLayers layers = point_layers(grid);
        const auto cell = [&] {
            return Cell{static_cast<int>(random() % static_cast<unsigned>(grid.width)),
                        static_cast<int>(random() % static_cast<unsigned>(grid.height))};
        };
        if (i % 2 == 0) {
            for (int k = 0; k < 8; ++k) {
                layers.blocked[random() % 4].set(cell(), true);
                layers.no_turn.set(cell(), true);
            }
        }
        const GridRequest request{cell(), cell()};
        if (request.start == request.goal) continue;

        const auto cells = blocking_cells(GridMap(layers), request);

        ASSERT_TRUE(cells) << i;
        ASSERT_EQ(cells->empty(), reachable(layers, request)) << i;
        GridLayers cleared = layers;
        for (const BlockingCell& blocking : *cells) clear(cleared, blocking.cell);
        ASSERT_TRUE(reachable(cleared, request)) << i;
        if (cells->size() < 2 || cells->size() > 3) continue;
        ++sets;
        // No single cell is enough, and for three no pair either.
        const int all = grid.width * grid.height;
        for (int a = 0; a < all; ++a) {
            for (int b = a; b < (cells->size() == 3 ? all : a + 1); ++b) {
                GridLayers fewer = layers;
                clear(fewer, {a % grid.width, a / grid.width});
                clear(fewer, {b % grid.width, b / grid.width});
                ASSERT_FALSE(reachable(fewer, request)) << i;
            }
        }
    }
    EXPECT_GT(sets, 40);
}

}  // namespace
}  // namespace pulseline::planning
