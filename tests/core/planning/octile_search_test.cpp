#include "core/planning/grid/octile_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/core/planning/grid_judge.hpp"

namespace pulseline::planning {
namespace {

/// Judge: Dijkstra over (cell, heading) with steps and turns from angles.
std::int64_t judge(const plant::OccupancyGrid& grid, const OctileRequest& request) {
    const auto free = [&](int col, int row) { return !grid.is_occupied(col, row); };
    if (!free(request.start.col, request.start.row) || !free(request.goal.col, request.goal.row)) {
        return kUnreached;
    }
    if (request.start == request.goal) return 0;
    std::vector<std::int64_t> best(grid.occupied.size() * 8, kUnreached);
    using Entry = std::tuple<std::int64_t, int, int, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto reach = [&](int col, int row, int d, std::int64_t cost) {
        auto& known = best[(static_cast<std::size_t>(row * grid.width + col)) * 8 +
                           static_cast<std::size_t>(d)];
        if (cost >= known) return;
        known = cost;
        open.push({cost, col, row, d});
    };
    const auto drive = [&](int col, int row, int heading, std::int64_t from) {
        for (int d = 0; d < 8; ++d) {
            const int dx = static_cast<int>(std::lround(std::cos(d * kPi / 4)));
            const int dy = static_cast<int>(std::lround(std::sin(d * kPi / 4)));
            if (!free(col + dx, row) || !free(col, row + dy) || !free(col + dx, row + dy)) continue;
            std::int64_t cost =
                from + std::llround(static_cast<double>(request.cost.step) * std::hypot(dx, dy));
            if (heading >= 0) {
                const double angle = std::abs(std::remainder((d - heading) * kPi / 4, 2 * kPi));
                cost += request.cost.turn * std::lround(angle / (kPi / 4)) / 2;
            }
            reach(col + dx, row + dy, d, cost);
        }
    };
    if (request.start_heading) {
        reach(request.start.col, request.start.row, *request.start_heading, 0);
    } else {
        drive(request.start.col, request.start.row, -1, 0);
    }
    while (!open.empty()) {
        const auto [cost, col, row, d] = open.top();
        open.pop();
        if (Cell{col, row} == request.goal) return cost;
        drive(col, row, d, cost);
    }
    return kUnreached;
}

TEST(OctileSearch, CostsWhatDijkstraSaysAndDrivesIt) {
    std::mt19937_64 random(13);
    OctileSearch search;
    OctileRoute route;
    int found = 0;
    for (int i = 0; i < 1'500; ++i) {
        auto grid =
            grid_of(1 + static_cast<int>(random() % 14), 1 + static_cast<int>(random() % 14));
        for (auto& cell : grid.occupied) cell = random() % 5 == 0;
        const GridMap map(point_layers(grid));
        const auto cell = [&] {
            return Cell{static_cast<int>(random() % static_cast<unsigned>(grid.width)),
                        static_cast<int>(random() % static_cast<unsigned>(grid.height))};
        };
        OctileRequest request{cell(), cell()};
        request.cost = {static_cast<std::int64_t>(random() % 20) * 500,
                        static_cast<std::int64_t>(random() % 30) * 500};
        if (random() % 2 == 0) request.start_heading = static_cast<int>(random() % 8);

        const SearchEnd end = search.run(map, request, route);

        const std::int64_t judged = judge(grid, request);
        ASSERT_EQ(end == SearchEnd::kFound, judged != kUnreached) << i;
        if (end != SearchEnd::kFound) continue;
        ++found;
        ASSERT_EQ(route.cost, judged) << i;
        ASSERT_EQ(route.cells.front(), request.start);
        ASSERT_EQ(route.cells.back(), request.goal);
        std::int64_t cost = 0;
        int turned = 0;
        int heading = request.start_heading.value_or(-1);
        for (std::size_t k = 1; k < route.cells.size(); ++k) {
            int d = 0;
            while (!(Cell{route.cells[k - 1].col + OctileSearch::kOctileStep[d].col,
                          route.cells[k - 1].row + OctileSearch::kOctileStep[d].row} ==
                     route.cells[k])) {
                ASSERT_LT(++d, 8);
            }
            ASSERT_TRUE(OctileSearch::may_step(map, route.cells[k - 1], d));
            cost += OctileSearch::step_cost(request.cost, d);
            if (heading >= 0) {
                cost += request.cost.turn * OctileSearch::eighths(heading, d) / 2;
                turned += OctileSearch::eighths(heading, d);
            }
            heading = d;
        }
        ASSERT_EQ(cost, route.cost) << i;
        ASSERT_EQ(turned, route.turn_eighths) << i;
    }
    EXPECT_GT(found, 600);
}

}  // namespace
}  // namespace pulseline::planning
