#include "core/planning/grid/grid_search.hpp"

#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "tests/core/planning/counted_new.hpp"
#include "tests/core/planning/grid_judge.hpp"

namespace pulseline::planning {
namespace {

GridMap footprint_map(const plant::OccupancyGrid& grid, const std::vector<geometry::Polygon>& body,
                      double clearance_m) {
    return GridMap(FootprintLayers(grid, body, clearance_m).layers());
}

TEST(GridSearch, ExpandsLittleMoreThanTheRouteOnAnEmptyFloor) {
    const GridMap map(point_layers(grid_of(200, 200)));
    const GridRequest request{{3, 5}, {190, 120}, std::nullopt, *unit_cell_cost(10, 20)};

    const auto stepwise = plan_grid(map, request, Algorithm::kBucket);
    const auto jumping = plan_grid(map, request);

    for (const auto& route : {stepwise, jumping}) {
        ASSERT_TRUE(route);
        EXPECT_EQ(route->turns, 1);
        EXPECT_DOUBLE_EQ(route->cost_in_k(), 10 * (187 + 115) + 10);
        EXPECT_EQ(route->corners.size(), 3u);
    }
    EXPECT_LT(stepwise->expanded, 2 * (187 + 115));
    EXPECT_LE(jumping->expanded, 4);
}

/// Two rooms of 30 m x 40 m joined by a gap of `gap_m` in the wall between them.
plant::OccupancyGrid rooms(double gap_m) {
    auto grid = grid_of(140, 80, 0.5);
    for (int row = 0; row < grid.height; ++row) {
        const double y = (row + 0.5) * grid.resolution_m;
        if (std::abs(y - 20) > gap_m / 2)
            grid.occupied[static_cast<std::size_t>(row) * 140 + 70] = 1;
    }
    return grid;
}

TEST(GridSearch, ThePlatformDoesNotFitWhereASmallVehicleDoes) {
    const auto grid = rooms(3);
    const auto small = footprint_map(grid, {geometry::rectangle(1.2, 0.8)}, 0.3);
    const auto large = footprint_map(grid, {geometry::rectangle(10.5, 2.5)}, 0.5);
    const GridRequest request{{30, 15}, {110, 65}, std::nullopt, *unit_cell_cost(10, 20)};

    EXPECT_TRUE(plan_grid(small, request));
    const auto refused = plan_grid(large, request);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.params.front().value, ParamValue{std::string("obstacles")});
    EXPECT_TRUE(plan_grid(footprint_map(rooms(6), {geometry::rectangle(10.5, 2.5)}, 0.5), request));
}

TEST(GridSearch, FootprintLayersKeepTheClearanceExactly) {
    std::mt19937_64 random(8);
    auto grid = grid_of(60, 50, 0.25);
    for (auto& cell : grid.occupied) cell = random() % 150 == 0;
    const geometry::Polygon body{{-1.5, -0.5}, {2.5, -0.3}, {2.5, 0.3}, {-1.5, 0.5}};
    constexpr double kClearance_m = 0.3;
    const FootprintLayers footprint(grid, {body}, kClearance_m);
    const GridLayers& layers = footprint.layers();
    int free_cells = 0;
    for (int i = 0; i < 150; ++i) {
        const Cell at{static_cast<int>(random() % 60), static_cast<int>(random() % 50)};
        const int d = static_cast<int>(random() % 4);
        const geometry::Pose2 pose{(at.col + 0.5) * 0.25, (at.row + 0.5) * 0.25, d * kPi / 2};
        const auto placed = geometry::transformed(pose, body);
        double least = 1e9;
        for (int row = -20; row < 70; ++row) {
            for (int col = -20; col < 80; ++col) {
                if (!grid.is_occupied(col, row)) continue;
                const geometry::Polygon cell{{col * 0.25, row * 0.25},
                                             {col * 0.25 + 0.25, row * 0.25},
                                             {col * 0.25 + 0.25, row * 0.25 + 0.25},
                                             {col * 0.25, row * 0.25 + 0.25}};
                least = std::min(least, geometry::distance(placed, cell));
            }
        }
        const bool blocked = layers.blocked[static_cast<std::size_t>(d)].test(at);
        EXPECT_TRUE(blocked || least >= kClearance_m - 1e-9) << least;
        EXPECT_TRUE(!blocked || least <= kClearance_m + 0.125 + 1e-9) << least;  // half a step
        free_cells += blocked ? 0 : 1;
    }
    EXPECT_GT(free_cells, 10);
}

TEST(GridSearch, TurnsOnlyWhereTheWholeBodyCan) {
    // A corridor 4 m wide with a bend: the small vehicle goes round, the long one cannot turn.
    auto grid = grid_of(80, 80, 0.25);
    for (int row = 0; row < 80; ++row) {
        for (int col = 0; col < 80; ++col) {
            const bool free = (row < 16) || (col >= 64);
            grid.occupied[static_cast<std::size_t>(row) * 80 + col] = free ? 0 : 1;
        }
    }
    const GridRequest request{{24, 8}, {72, 55}, std::nullopt, *unit_cell_cost(1, 2)};
    EXPECT_TRUE(plan_grid(footprint_map(grid, {geometry::rectangle(1.2, 0.8)}, 0.2), request));
    EXPECT_FALSE(plan_grid(footprint_map(grid, {geometry::rectangle(8, 0.8)}, 0.2), request));
}

TEST(GridSearch, NamesWhatIsWrong) {
    auto grid = grid_of(4, 4);
    grid.occupied[5] = 1;
    const GridMap map(point_layers(grid));
    const auto outside = plan_grid(map, {{0, 0}, {4, 0}, std::nullopt, {}});
    EXPECT_EQ(outside.error().reason.code, "outside_grid");
    EXPECT_EQ(outside.error().field, "/goal");
    const auto start = plan_grid(map, {{1, 1}, {3, 3}, std::nullopt, {}});
    EXPECT_EQ(start.error().reason.params.front().value, ParamValue{std::string("start")});
    EXPECT_FALSE(unit_cell_cost(-1, 5));
    EXPECT_FALSE(unit_cell_cost(1, 1e300));
}

TEST(GridSearch, ScalesCostsToThousandths) {
    EXPECT_EQ(*unit_cell_cost(10, 20), (GridCost{10'000, 10'000}));
    EXPECT_EQ(*unit_cell_cost(0.8, 0.5), (GridCost{800, -300}));
}

TEST(GridSearch, JumpsOnlyWhereItsConditionsHold) {
    GridLayers layers = point_layers(grid_of(9, 9));
    const auto answered_by = [&](GridCost cost) {
        const auto route = plan_grid(GridMap(layers), {{0, 0}, {8, 5}, std::nullopt, cost});
        EXPECT_TRUE(route);
        return route->algorithm;
    };
    EXPECT_EQ(answered_by({10, 10}), Algorithm::kTurnJump);
    EXPECT_EQ(answered_by({10, -3}), Algorithm::kBucket);                       // cheap turns
    EXPECT_EQ(answered_by({1'000'000'007, 1'000'000'009}), Algorithm::kAstar);  // 64 bits

    layers.weight.assign(81, 1);
    EXPECT_EQ(answered_by({10, 10}), Algorithm::kBucket);
}

TEST(GridSearch, OnFloorThatIsNotUniformTheWayOverPlainCellsIsToBeBeaten) {
    // A wall with two gates: the near one, on the way, may be driven through but not turned in.
    GridLayers layers = point_layers(grid_of(9, 9));
    for (int row = 1; row < 8; ++row) {
        for (auto& layer : layers.blocked) layer.set({4, row}, row != 4);
    }
    const GridRequest request{{0, 4}, {8, 4}, std::nullopt, {10, 10}};
    for (auto& layer : layers.blocked) layer.set({4, 4}, true);
    EXPECT_EQ(plan_grid(GridMap(layers), request)->cost, 180);  // by the edge: 16 cells, 2 turns
    for (auto& layer : layers.blocked) layer.set({4, 4}, false);
    layers.no_turn.set({4, 4}, true);
    const auto through = plan_grid(GridMap(layers), request);
    EXPECT_EQ(through->cost, 80);
    EXPECT_EQ(through->algorithm, Algorithm::kBucket);

    // Nothing beats the way over plain cells, which the bucket search then only confirms.
    GridLayers open = point_layers(grid_of(9, 9));
    open.no_turn.set({4, 7}, true);
    open.make_one_way({2, 8}, Direction::kWest);
    const auto plain = plan_grid(GridMap(open), request);
    EXPECT_EQ(plain->cost, 80);
    EXPECT_EQ(plain->algorithm, Algorithm::kTurnJump);
}

TEST(GridSearch, StopsWhenItIsToldTo) {
    std::mt19937_64 random(3);
    auto grid = grid_of(99, 99);  // small enough to be left to the turn-jump search
    for (auto& cell : grid.occupied) cell = random() % 6 == 0;
    grid.occupied.front() = grid.occupied.back() = 0;
    const GridMap map(point_layers(grid));
    ASSERT_TRUE(map.jumps_pay());
    std::atomic<bool> cancel = true;
    for (const auto algorithm :
         {Algorithm::kDijkstra, Algorithm::kAstar, Algorithm::kBucket, Algorithm::kTurnJump}) {
        const auto stopped =
            plan_grid(map, {{0, 0}, {98, 98}, std::nullopt, {10, 10}, &cancel}, algorithm);
        ASSERT_FALSE(stopped);
        EXPECT_EQ(stopped.error().reason.code, "cancelled") << to_string(algorithm);
    }
}

TEST(GridSearch, AllocatesNothingOnceWarm) {
    std::mt19937_64 random(5);
    auto grid = grid_of(120, 80);  // small enough to be left to the turn-jump search
    for (auto& cell : grid.occupied) cell = random() % 4 == 0;
    GridLayers oneway = point_layers(grid);
    oneway.make_one_way({7, 7}, Direction::kEast);
    const GridMap maps[] = {GridMap(point_layers(grid)), GridMap(oneway)};
    std::vector<GridRequest> requests;
    for (int i = 0; i < 200; ++i) {
        const auto cell = [&] {
            return Cell{static_cast<int>(random() % 120), static_cast<int>(random() % 80)};
        };
        requests.push_back({cell(), cell(), std::nullopt, *unit_cell_cost(10, 20)});
    }
    GridSearch search;
    GridRoute route;
    const auto ask_all = [&] {
        int found = 0;
        for (const GridMap& map : maps) {
            for (const auto algorithm : {Algorithm::kDijkstra, Algorithm::kAstar,
                                         Algorithm::kBucket, Algorithm::kTurnJump}) {
                for (const GridRequest& request : requests) {
                    found += search.run(map, request, algorithm, route) == SearchEnd::kFound;
                }
            }
        }
        return found;
    };
    ask_all();

    const std::int64_t before = allocations();
    const int found = ask_all();

    EXPECT_EQ(allocations(), before);
    EXPECT_GT(found, 400);
}

TEST(GridSearch, ManyThreadsReadOneMap) {
    std::mt19937_64 random(6);
    auto grid = grid_of(96, 96);  // small enough to be left to the turn-jump search
    for (auto& cell : grid.occupied) cell = random() % 5 == 0;
    const GridMap map(point_layers(grid));
    std::vector<std::vector<std::int64_t>> costs(4);
    std::vector<std::thread> threads;
    for (auto& own : costs) {
        threads.emplace_back([&map, &own] {
            std::mt19937_64 same(7);
            GridSearch search;
            GridRoute route;
            for (int i = 0; i < 300; ++i) {
                const auto cell = [&] {
                    return Cell{static_cast<int>(same() % 96), static_cast<int>(same() % 96)};
                };
                const GridRequest request{cell(), cell()};
                const auto end = search.run(map, request, Algorithm::kTurnJump, route);
                own.push_back(end == SearchEnd::kFound ? route.cost : -1);
            }
        });
    }
    for (auto& thread : threads) thread.join();
    for (const auto& own : costs) EXPECT_EQ(own, costs.front());
}

TEST(FootprintLayers, FollowEditsOfTheMap) {
    std::mt19937_64 random(12);
    auto grid = grid_of(70, 40, 0.25);
    for (auto& cell : grid.occupied) cell = random() % 60 == 0;
    const std::vector<geometry::Polygon> body{geometry::rectangle(1.6, 0.7)};
    FootprintLayers footprint(grid, body, 0.2);
    GridMap map(footprint.layers());
    for (int i = 0; i < 60; ++i) {
        const Cell cell{static_cast<int>(random() % 70), static_cast<int>(random() % 40)};
        auto& occupied = grid.occupied[static_cast<std::size_t>(cell.row * 70 + cell.col)];
        occupied = occupied ? 0 : 1;

        map.update(footprint.layers(), footprint.set_occupied(cell, occupied != 0));

        const GridMap fresh(FootprintLayers(grid, body, 0.2).layers());
        ASSERT_EQ(map.layers().blocked, fresh.layers().blocked) << i;
        ASSERT_EQ(map.layers().no_turn, fresh.layers().no_turn) << i;
        for (std::size_t c = 0; c < map.padded_cells(); ++c) {
            ASSERT_EQ(map.moves(c), fresh.moves(c)) << i;
        }
    }
}

}  // namespace
}  // namespace pulseline::planning
