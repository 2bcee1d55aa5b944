#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/traffic/tiles.hpp"

namespace pulseline::traffic {
namespace {

using geometry::Point2;
using geometry::Polygon;

Polygon square_of(TileId tile) {
    const auto box = tile_box(tile);
    return {box.min, {box.max.x_m, box.min.y_m}, box.max, {box.min.x_m, box.max.y_m}};
}

Polygon random_convex(std::mt19937_64& random) {
    std::uniform_real_distribution<double> place(-20, 20);
    std::uniform_real_distribution<double> spread(-3, 3);
    const Point2 centre{place(random), place(random)};
    std::vector<Point2> points;
    for (int i = 0; i < 8; ++i) points.push_back(centre + Point2{spread(random), spread(random)});
    return geometry::convex_hull(points);
}

TEST(TilesUnder, HoldEveryTileTouchedAndHardlyMore) {
    std::mt19937_64 random(21);
    for (int i = 0; i < 150; ++i) {
        const Polygon piece = random_convex(random);
        const double margin = i % 3 == 0 ? 0 : 0.1 * (i % 7);
        const TileSet tiles = tiles_under(1, {piece}, margin);
        const auto box = geometry::bounding_box(piece);
        TileSet around = tiles_under(1,
                                     {{{box.min.x_m - 2, box.min.y_m - 2},
                                       {box.max.x_m + 2, box.min.y_m - 2},
                                       {box.max.x_m + 2, box.max.y_m + 2},
                                       {box.min.x_m - 2, box.max.y_m + 2}}},
                                     0);
        for (const TileId tile : around) {
            const double away = geometry::distance(square_of(tile), piece);
            const bool held = std::binary_search(tiles.begin(), tiles.end(), tile);
            EXPECT_TRUE(held || away > margin) << away << " of " << margin;
            EXPECT_TRUE(!held || away <= margin * 1.083 + 1e-6) << away << " of " << margin;
        }
    }
}

TEST(TilesUnder, TouchingATileCounts) {
    // The square's sides lie on tile borders: the neighbours outside are touched too.
    const TileSet tiles = tiles_under(0, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, 0);
    EXPECT_EQ(tiles.size(), 16u);
}

TEST(TilesUnder, WhatLiesNowhereCoversNone) {
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(tiles_under(0, {{{infinite, 0}, {1, 0}, {1, 1}}}, 0.1).empty());
    EXPECT_TRUE(tiles_under(0, {{{0, 0}, {1, -infinite}, {1, 1}}}, 0).empty());
    // Beyond what a tile can name lies its outermost one.
    const TileSet outermost = tiles_under(0, {{{1e300, 1e300}}}, 0);
    ASSERT_EQ(outermost.size(), 1u);
    EXPECT_GT(tile_box(outermost.front()).min.x_m, 1e6);
    EXPECT_GT(tile_box(outermost.front()).min.y_m, 1e6);
}

TEST(TilesUnder, AreSortedUniqueAndCarryTheirPlace) {
    const TileSet tiles = tiles_under(3, {{{-7.3, 4.1}}, {{-7.3, 4.1}}}, 0);
    ASSERT_EQ(tiles.size(), 1u);
    const auto box = tile_box(tiles.front());
    EXPECT_EQ(box.min, (Point2{-7.5, 4.0}));
    EXPECT_EQ(box.max, (Point2{-7.0, 4.5}));
}

TEST(TilesUnder, PlatformsParkedThreeMetresApartShareNone) {
    const auto body = geometry::rectangle(10.5, 2.5);
    for (const double y : {20.0, 20.13, 20.37}) {
        const auto a = tiles_under(0, {geometry::transformed({50, y, 0}, body)}, 0.1);
        const auto b = tiles_under(0, {geometry::transformed({50, y + 3 + 2.5, 0}, body)}, 0.1);
        EXPECT_EQ(merge(a, b).size(), a.size() + b.size());
    }
}

}  // namespace
}  // namespace pulseline::traffic
