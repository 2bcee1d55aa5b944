#include "core/traffic/tile_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace pulseline::traffic {
namespace {

const plant::VehicleId kA("A");
const plant::VehicleId kB("B");

TEST(TileMap, HoldsAllOrNothingAndNamesTheHolder) {
    TileMap map;
    ASSERT_FALSE(map.try_hold(kA, {1, 2, 3}));

    const auto blocker = map.try_hold(kB, {3, 4, 5});

    ASSERT_TRUE(blocker);
    EXPECT_EQ(blocker->vehicle, kA);
    EXPECT_EQ(blocker->tile, 3u);
    EXPECT_TRUE(map.held_by(kB).empty());
    EXPECT_FALSE(map.holder(4));
}

TEST(TileMap, FreedTilesCanBeHeldByAnother) {
    TileMap map;
    ASSERT_FALSE(map.try_hold(kA, {1, 2, 3}));

    map.keep_only(kA, {3});

    EXPECT_FALSE(map.try_hold(kB, {1, 2}));
    EXPECT_TRUE(map.try_hold(kB, {3}));
    EXPECT_EQ(map.held_by(kA), TileSet{3});
}

TEST(TileMap, NoTileEverHasTwoHolders) {
    std::mt19937 random(5);
    TileMap map;
    std::map<plant::VehicleId, TileSet> model;
    const std::vector<plant::VehicleId> vehicles{kA, kB, plant::VehicleId("C")};
    for (int i = 0; i < 5'000; ++i) {
        const auto& vehicle = vehicles[random() % 3];
        TileSet tiles;
        for (int k = 0; k < 6; ++k) tiles.push_back(random() % 40);
        std::sort(tiles.begin(), tiles.end());
        tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
        if (random() % 3 == 0) {
            map.keep_only(vehicle, tiles);
            std::erase_if(model[vehicle], [&](TileId t) {
                return !std::binary_search(tiles.begin(), tiles.end(), t);
            });
        } else {
            const bool clash =
                std::any_of(vehicles.begin(), vehicles.end(), [&](const auto& other) {
                    return other != vehicle &&
                           std::any_of(tiles.begin(), tiles.end(), [&](TileId t) {
                               return std::binary_search(model[other].begin(), model[other].end(),
                                                         t);
                           });
                });
            EXPECT_EQ(map.try_hold(vehicle, tiles).has_value(), clash);
            if (!clash) model[vehicle] = merge(model[vehicle], tiles);
        }
        for (const auto& each : vehicles) EXPECT_EQ(map.held_by(each), model[each]);
    }
}

TEST(TilesUnder, NeverMissATileThatTheGrownBodyTouches) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(-30, 30);
    std::uniform_real_distribution<double> turn(-kPi, kPi);
    constexpr double kMargin_m = 0.1;
    for (int i = 0; i < 300; ++i) {
        const auto body = geometry::transformed({place(random), place(random), turn(random)},
                                                geometry::rectangle(10.5, 2.5));
        const TileSet tiles = tiles_under(2, {body}, kMargin_m);
        const auto box = geometry::bounding_box(body);
        for (double x = box.min.x_m - 1; x < box.max.x_m + 1; x += kTile_m) {
            for (double y = box.min.y_m - 1; y < box.max.y_m + 1; y += kTile_m) {
                const auto one = tiles_under(2, {{{x, y}}}, 0);
                const auto tile = tile_box(one.front());
                const geometry::Polygon square{
                    tile.min, {tile.max.x_m, tile.min.y_m}, tile.max, {tile.min.x_m, tile.max.y_m}};
                if (geometry::distance(square, body) < kMargin_m - 1e-9) {
                    EXPECT_TRUE(std::binary_search(tiles.begin(), tiles.end(), one.front()));
                }
            }
        }
    }
}

TEST(TilesUnder, HallsDoNotShareTiles) {
    const auto body = geometry::rectangle(3, 1);
    const auto a = tiles_under(0, {body}, 0);
    const auto b = tiles_under(1, {body}, 0);
    EXPECT_EQ(a.size(), b.size());
    EXPECT_EQ(merge(a, b).size(), a.size() + b.size());
}

}  // namespace
}  // namespace pulseline::traffic
