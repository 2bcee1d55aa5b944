#include "core/planning/grid_search.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <queue>
#include <random>

namespace pulseline::planning {
namespace {

constexpr std::int64_t kUnreached = std::numeric_limits<std::int64_t>::max();
constexpr Cell kStep[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

plant::OccupancyGrid grid_of(int width, int height, double resolution_m = 1) {
    plant::OccupancyGrid grid;
    grid.width = width;
    grid.height = height;
    grid.resolution_m = resolution_m;
    grid.occupied.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    return grid;
}

/// Judge: Dijkstra over (cell, direction), nothing clever.
std::int64_t dijkstra(const GridLayers& layers, const GridRequest& request) {
    const auto state = [&](Cell cell, int d) {
        return layers.index(cell) * 4 + static_cast<std::size_t>(d);
    };
    const auto free = [&](Cell cell, int d) {
        return layers.inside(cell) &&
               !layers.blocked[static_cast<std::size_t>(d)][layers.index(cell)];
    };
    if (request.start == request.goal) {
        for (int d = 0; d < 4; ++d) {
            if (free(request.start, d)) return 0;
        }
        return kUnreached;
    }
    std::vector<std::int64_t> best(layers.no_turn.size() * 4, kUnreached);
    using Entry = std::tuple<std::int64_t, int, int, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto reach = [&](Cell cell, int d, std::int64_t cost) {
        if (!free(cell, d) || cost >= best[state(cell, d)]) return;
        best[state(cell, d)] = cost;
        open.push({cost, cell.col, cell.row, d});
    };
    for (int d = 0; d < 4; ++d) {
        const Cell next{request.start.col + kStep[d].col, request.start.row + kStep[d].row};
        if (!request.start_heading) {  // the first step is no turn
            if (free(request.start, d)) reach(next, d, request.cost.step);
        } else if (static_cast<int>(*request.start_heading) == d) {
            reach(request.start, d, 0);
        }
    }
    while (!open.empty()) {
        const auto [cost, col, row, d] = open.top();
        open.pop();
        const Cell cell{col, row};
        if (cost > best[state(cell, d)]) continue;
        if (cell == request.goal) return cost;
        for (int e = 0; e < 4; ++e) {
            if (e != d && (layers.no_turn[layers.index(cell)] || !free(cell, e))) continue;
            reach({col + kStep[e].col, row + kStep[e].row}, e,
                  cost + request.cost.step + (e == d ? 0 : request.cost.turn));
        }
    }
    return kUnreached;
}

int direction(Cell from, Cell to) {
    for (int d = 0; d < 4; ++d) {
        if (from.col + kStep[d].col == to.col && from.row + kStep[d].row == to.row) return d;
    }
    ADD_FAILURE() << "no neighbours";
    return 0;
}

void expect_valid(const GridLayers& layers, const GridRequest& request, const GridRoute& route) {
    ASSERT_FALSE(route.cells.empty());
    EXPECT_EQ(route.cells.front(), request.start);
    EXPECT_EQ(route.cells.back(), request.goal);
    EXPECT_EQ(route.length + 1, static_cast<int>(route.cells.size()));
    int turns = 0;
    int heading = request.start_heading ? static_cast<int>(*request.start_heading) : -1;
    for (std::size_t i = 1; i < route.cells.size(); ++i) {
        const Cell from = route.cells[i - 1];
        const int d = direction(from, route.cells[i]);
        const auto& layer = layers.blocked[static_cast<std::size_t>(d)];
        EXPECT_FALSE(layer[layers.index(from)]);
        EXPECT_FALSE(layer[layers.index(route.cells[i])]);
        if (heading >= 0 && d != heading) {
            EXPECT_FALSE(layers.no_turn[layers.index(from)]);
            ++turns;
        }
        heading = d;
    }
    EXPECT_EQ(route.turns, turns);
    const auto cost = request.cost.step * route.length + request.cost.turn * turns;
    EXPECT_DOUBLE_EQ(route.cost, static_cast<double>(cost) / kCostUnit);
}

TEST(GridSearch, CostsWhatDijkstraSaysOnRandomGrids) {
    const double same[] = {0, 0.3, 0.8, 1, 2.5, 10};
    const double diff[] = {0, 0.1, 0.5, 1, 1.6, 7, 20, 100};
    std::mt19937_64 random(4711);
    int routes = 0;
    for (int i = 0; i < 6'000; ++i) {
        auto grid =
            grid_of(1 + static_cast<int>(random() % 16), 1 + static_cast<int>(random() % 16));
        const auto density = 2 + random() % 6;
        for (auto& cell : grid.occupied) cell = random() % density == 0;
        GridLayers layers = point_layers(grid);
        if (i % 3 ==
            0) {  // as a footprint makes them: other cells by heading, turns not everywhere
            for (auto& layer : layers.blocked) {
                for (auto& cell : layer) cell = cell || random() % 8 == 0;
            }
            for (auto& cell : layers.no_turn) cell = random() % 3 == 0;
        }
        const auto cell = [&] {
            return Cell{static_cast<int>(random() % static_cast<unsigned>(grid.width)),
                        static_cast<int>(random() % static_cast<unsigned>(grid.height))};
        };
        GridRequest request{cell(), cell(), std::nullopt,
                            *unit_cell_cost(same[random() % 6], diff[random() % 8])};
        if (random() % 2 == 0) request.start_heading = static_cast<Direction>(random() % 4);

        const auto route = plan_grid(layers, request);

        const std::int64_t judged = dijkstra(layers, request);
        ASSERT_EQ(route.has_value(), judged != kUnreached) << "grid " << i;
        if (!route) {
            EXPECT_EQ(route.error().reason.code, "no_route");
            continue;
        }
        ASSERT_DOUBLE_EQ(route->cost, static_cast<double>(judged) / kCostUnit) << "grid " << i;
        expect_valid(layers, request, *route);
        ++routes;
    }
    EXPECT_GT(routes, 2'000);
}

TEST(GridSearch, ExpandsLittleMoreThanTheRouteOnAnEmptyFloor) {
    const GridLayers layers = point_layers(grid_of(200, 200));
    const auto route =
        plan_grid(layers, {{3, 5}, {190, 120}, std::nullopt, *unit_cell_cost(10, 20)});
    ASSERT_TRUE(route);
    EXPECT_EQ(route->turns, 1);
    EXPECT_DOUBLE_EQ(route->cost, 10 * (187 + 115) + 10);
    EXPECT_LT(route->expanded, 2 * (187 + 115));
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
    const auto small = footprint_layers(grid, {geometry::rectangle(1.2, 0.8)}, 0.3);
    const auto large = footprint_layers(grid, {geometry::rectangle(10.5, 2.5)}, 0.5);
    const GridRequest request{{30, 15}, {110, 65}, std::nullopt, *unit_cell_cost(10, 20)};

    EXPECT_TRUE(plan_grid(small, request));
    const auto refused = plan_grid(large, request);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.params.front().value, ParamValue{std::string("obstacles")});
    EXPECT_TRUE(
        plan_grid(footprint_layers(rooms(6), {geometry::rectangle(10.5, 2.5)}, 0.5), request));
}

TEST(GridSearch, FootprintLayersKeepTheClearanceExactly) {
    std::mt19937_64 random(8);
    auto grid = grid_of(60, 50, 0.25);
    for (auto& cell : grid.occupied) cell = random() % 150 == 0;
    const geometry::Polygon body{{-1.5, -0.5}, {2.5, -0.3}, {2.5, 0.3}, {-1.5, 0.5}};
    constexpr double kClearance_m = 0.3;
    const auto layers = footprint_layers(grid, {body}, kClearance_m);
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
        const bool blocked = layers.blocked[static_cast<std::size_t>(d)][layers.index(at)] != 0;
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
    EXPECT_TRUE(plan_grid(footprint_layers(grid, {geometry::rectangle(1.2, 0.8)}, 0.2), request));
    EXPECT_FALSE(plan_grid(footprint_layers(grid, {geometry::rectangle(8, 0.8)}, 0.2), request));
}

TEST(GridSearch, NamesWhatIsWrong) {
    auto grid = grid_of(4, 4);
    grid.occupied[5] = 1;
    const GridLayers layers = point_layers(grid);
    const auto outside = plan_grid(layers, {{0, 0}, {4, 0}, std::nullopt, {}});
    EXPECT_EQ(outside.error().reason.code, "outside_grid");
    EXPECT_EQ(outside.error().field, "/goal");
    const auto start = plan_grid(layers, {{1, 1}, {3, 3}, std::nullopt, {}});
    EXPECT_EQ(start.error().reason.params.front().value, ParamValue{std::string("start")});
    EXPECT_FALSE(unit_cell_cost(-1, 5));
    EXPECT_FALSE(unit_cell_cost(1, 1e300));
}

}  // namespace
}  // namespace pulseline::planning
