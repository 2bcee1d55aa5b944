// Random grids, costs and restrictions: every search against the judge, in cost and step by step.
// PULSELINE_FUZZ_QUERIES sets the number of queries (50,000 without it).
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "core/planning/grid/grid_search.hpp"
#include "tests/core/planning/grid_judge.hpp"

namespace pulseline::planning {
namespace {

using Random = std::mt19937_64;

int queries() {
    const char* count = std::getenv("PULSELINE_FUZZ_QUERIES");
    return count ? std::atoi(count) : 50'000;
}

int below(Random& random, int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
}

/// k as a hall or an experiment may have it: whole and awkward, below and above 1, cheap turns too.
GridCost random_cost(Random& random) {
    const double whole[] = {0, 1, 2, 5, 10, 20, 100};
    std::uniform_real_distribution<double> any(0, 3);
    const auto k = [&] { return random() % 2 == 0 ? whole[random() % 7] : any(random); };
    const double same = k();
    if (random() % 4 == 0) return *unit_cell_cost(same, k());
    return *unit_cell_cost(same, same + k());  // turns cost extra
}

plant::OccupancyGrid random_grid(Random& random, int most) {
    auto grid = grid_of(1 + below(random, most), 1 + below(random, most));
    const auto mark = [&](int col, int row, bool occupied) {
        grid.occupied[static_cast<std::size_t>(row * grid.width + col)] = occupied ? 1 : 0;
    };
    if (random() % 3 != 0) {  // scattered cells
        const auto density = 2 + random() % 9;
        for (auto& cell : grid.occupied) cell = random() % density == 0;
    } else {  // walls with gaps
        for (int i = below(random, most); i > 0; --i) {
            const bool along = random() % 2 == 0;
            const int line = below(random, along ? grid.height : grid.width);
            for (int p = 0; p < (along ? grid.width : grid.height); ++p) {
                if (random() % 6 == 0) continue;
                along ? mark(p, line, true) : mark(line, p, true);
            }
        }
    }
    return grid;
}

/// As footprints, one-way lanes and slow zones make them.
void restrict(Random& random, GridLayers& layers) {
    const auto for_some = [&](unsigned one_in, auto change) {
        for (int row = 0; row < layers.height; ++row) {
            for (int col = 0; col < layers.width; ++col) {
                if (random() % one_in == 0) change(Cell{col, row});
            }
        }
    };
    const auto kinds = 1 + random() % 15;
    if ((kinds & 1) != 0) {
        for (auto& layer : layers.blocked) {
            for_some(8, [&](Cell cell) { layer.set(cell, true); });
        }
    }
    if ((kinds & 2) != 0) for_some(3, [&](Cell cell) { layers.no_turn.set(cell, true); });
    if ((kinds & 4) != 0) {
        for_some(
            6, [&](Cell cell) { layers.make_one_way(cell, static_cast<Direction>(random() % 4)); });
    }
    if ((kinds & 8) != 0) {
        layers.weight.assign(static_cast<std::size_t>(layers.width * layers.height), 1);
        for (auto& weight : layers.weight) weight = static_cast<std::uint8_t>(1 + random() % 4);
    }
}

GridRequest random_request(Random& random, const GridLayers& layers) {
    const auto cell = [&] {
        Cell at{below(random, layers.width), below(random, layers.height)};
        for (int i = 0; i < 4 && layers.blocked[0].test(at); ++i) {
            at = {below(random, layers.width), below(random, layers.height)};
        }
        return at;
    };
    GridRequest request{cell(), cell()};
    if (random() % 2 == 0) request.start_heading = static_cast<Direction>(random() % 4);
    request.cost = random_cost(random);
    return request;
}

struct Tally {
    int asked = 0;
    int found = 0;
    int jumped = 0;
};

void expect_judged(GridSearch& search, const GridMap& map, const GridRequest& request,
                   Tally& tally) {
    const std::int64_t judged = judge(map.layers(), request);
    for (const auto algorithm : {Algorithm::kAstar, Algorithm::kBucket, Algorithm::kTurnJump}) {
        GridRoute route;
        const SearchEnd end = search.run(map, request, algorithm, route);
        ASSERT_EQ(end, judged == kUnreached ? SearchEnd::kNoRoute : SearchEnd::kFound)
            << to_string(algorithm);
        if (algorithm == Algorithm::kTurnJump) {
            ++tally.asked;
            tally.found += end == SearchEnd::kFound ? 1 : 0;
            tally.jumped += route.algorithm == Algorithm::kTurnJump ? 1 : 0;
        }
        if (end != SearchEnd::kFound) continue;
        ASSERT_EQ(route.cost, judged) << to_string(algorithm);
        ASSERT_EQ(fault(map.layers(), request, route), "") << to_string(algorithm);
    }
}

TEST(GridFuzz, EverySearchCostsWhatDijkstraSays) {
    Random random(4711);
    GridSearch search;
    Tally tally;
    for (int i = 0; tally.asked < queries(); ++i) {
        const int most = i % 50 == 0 ? 140 : i % 5 == 0 ? 40 : 16;  // past one and two words too
        GridLayers layers = point_layers(random_grid(random, most));
        if (random() % 4 == 0) restrict(random, layers);
        const GridMap map(layers);
        for (int k = 0; k < 10 && tally.asked < queries(); ++k) {
            const GridRequest request = random_request(random, layers);
            expect_judged(search, map, request, tally);
            if (HasFatalFailure()) {
                FAIL() << "grid " << i << " query " << k << " cost " << request.cost.step << "+"
                       << request.cost.turn;
            }
        }
    }
    EXPECT_GT(tally.found, tally.asked / 2);
    EXPECT_GT(tally.jumped, tally.asked / 2);
    RecordProperty("queries", tally.asked);
}

TEST(GridFuzz, EditedMapsAnswerAsNewOnes) {
    Random random(99);
    GridSearch search;
    Tally tally;
    for (int i = 0; i < 120; ++i) {
        GridMap map(point_layers(random_grid(random, i % 4 == 0 ? 90 : 20)));
        for (int edit = 0; edit < 25; ++edit) {
            const Cell cell{below(random, map.width()), below(random, map.height())};
            map.set_blocked(cell, !map.layers().blocked[0].test(cell));
            const GridMap fresh(map.layers());
            ASSERT_TRUE(map.planes() == fresh.planes()) << "grid " << i << " edit " << edit;
            expect_judged(search, map, random_request(random, map.layers()), tally);
            if (HasFatalFailure()) FAIL() << "grid " << i << " edit " << edit;
        }
    }
    EXPECT_GT(tally.found, 500);
}

}  // namespace
}  // namespace pulseline::planning
