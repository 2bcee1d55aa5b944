#include "tests/bench/grid_bench.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>

#include "core/planning/grid/grid_search.hpp"
#include "tests/bench/generated_maps.hpp"

namespace pulseline::bench {
namespace {

using namespace planning;
using Timer = std::chrono::steady_clock;

double us_since(Timer::time_point begin) {
    return std::chrono::duration<double, std::micro>(Timer::now() - begin).count();
}

/// Plain A* on cells, 4-connected, without turn costs: the yardstick (binary heap, stamps).
class CellSearch {
public:
    explicit CellSearch(const GridMap& map) : map_(map), labels_(map.padded_cells()) {}

    SearchEnd run(const GridRequest& request, GridRoute& route) {
        ++stamp_;
        open_.clear();
        goal_ = request.goal;
        route.expanded = 0;
        reach(request.start, 0, 0);
        while (!open_.empty()) {
            const Open top = open_.front();
            std::pop_heap(open_.begin(), open_.end());
            open_.pop_back();
            const std::size_t at = map_.padded(top.cell);
            if (top.cost != labels_[at].cost) continue;
            if (top.cell == goal_) {
                route.length = static_cast<int>(top.cost);
                route.corners.clear();
                for (Cell cell = goal_; !(cell == request.start);) {  // cells: no corners known
                    route.corners.push_back(cell);
                    const Cell step = kStep[labels_[map_.padded(cell)].by];
                    cell = {cell.col - step.col, cell.row - step.row};
                }
                return SearchEnd::kFound;
            }
            ++route.expanded;
            for (unsigned d = 0; d < kDirections; ++d) {
                if ((map_.moves(at) >> d & 1) == 0) continue;
                reach({top.cell.col + kStep[d].col, top.cell.row + kStep[d].row}, top.cost + 1, d);
            }
        }
        return SearchEnd::kNoRoute;
    }

private:
    struct Label {
        std::uint32_t stamp = 0;
        std::int32_t cost = 0;
        unsigned by = 0;
    };
    struct Open {
        std::int32_t estimate;
        std::int32_t cost;
        Cell cell;
        bool operator<(const Open& other) const {
            return estimate != other.estimate ? estimate > other.estimate : cost < other.cost;
        }
    };
    void reach(Cell cell, std::int32_t cost, unsigned by) {
        Label& label = labels_[map_.padded(cell)];
        if (label.stamp == stamp_ && cost >= label.cost) return;
        label = {stamp_, cost, by};
        open_.push_back({cost + manhattan(cell, goal_), cost, cell});
        std::push_heap(open_.begin(), open_.end());
    }

    const GridMap& map_;
    std::vector<Label> labels_;
    std::vector<Open> open_;
    std::uint32_t stamp_ = 0;
    Cell goal_;
};

struct Figures {
    std::string name;
    std::vector<double> us;  // least per problem
    std::vector<std::int64_t> cost;
    std::int64_t expanded = 0;

    double mean_us() const {
        double sum = 0;
        for (const double t : us) sum += t;
        return sum / static_cast<double>(us.size());
    }
    double quantile_us(double q) const {
        auto sorted = us;
        std::sort(sorted.begin(), sorted.end());
        return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
    }
    double mean_expanded() const {
        return static_cast<double>(expanded) / static_cast<double>(us.size());
    }
};

struct Contender {
    std::string name;
    std::function<SearchEnd(const GridRequest&, GridRoute&)> query;
};

// The slow searches on the big maps get one run a problem and round, the fast ones many.
constexpr double kBudget_us = 1e6;
constexpr int kMostRuns = 10;

/// One round over all problems; a problem's time is the least of all rounds.
void measure(const BenchMap& map, const Contender& contender, Figures& figures) {
    figures.us.resize(map.problems.size(), std::numeric_limits<double>::infinity());
    figures.cost.clear();
    figures.expanded = 0;
    GridRoute route;
    for (std::size_t p = 0; p < map.problems.size(); ++p) {
        GridRequest request{map.problems[p].start, map.problems[p].goal};
        request.cost = *unit_cell_cost(10, 20);
        const double share = kBudget_us / static_cast<double>(map.problems.size());
        double spent = 0;
        SearchEnd end = SearchEnd::kNoRoute;
        for (int i = 0; i < kMostRuns && (i == 0 || spent < share); ++i) {
            const auto begin = Timer::now();
            end = contender.query(request, route);
            const double time = us_since(begin);
            figures.us[p] = std::min(figures.us[p], time);
            spent += time;
        }
        figures.cost.push_back(end == SearchEnd::kFound ? route.cost : -1);
        figures.expanded += route.expanded;
    }
}

/// In turns, so that what else the machine does for a while spoils no comparison.
std::vector<Figures> measure(const BenchMap& map, const std::vector<Contender>& contenders,
                             int rounds) {
    std::vector<Figures> figures;
    for (const Contender& contender : contenders) figures.push_back({contender.name, {}, {}, 0});
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            measure(map, contenders[i], figures[i]);
        }
    }
    return figures;
}

nlohmann::json bench_map(const BenchMap& bench_map) {
    auto begin = Timer::now();
    GridMap map(point_layers(bench_map.grid));
    double build_us = us_since(begin);
    for (int i = 0; i < 3; ++i) {
        begin = Timer::now();
        map = GridMap(point_layers(bench_map.grid));
        build_us = std::min(build_us, us_since(begin));
    }
    std::printf("\n%s: %d x %d, %zu problems, map %.2f MB built in %.2f ms\n",
                bench_map.name.c_str(), map.width(), map.height(), bench_map.problems.size(),
                static_cast<double>(map.bytes()) / 1e6, build_us / 1e3);
    std::printf("  %-18s %11s %11s %11s %11s %9s %9s %9s\n", "search", "mean us", "p50 us",
                "p99 us", "expanded", "ns each", "scratch", "/ bucket");
    nlohmann::json rows = nlohmann::json::array();
    std::vector<Figures> all;
    const auto show = [&](Figures figures, std::size_t bytes) {
        const double each = 1e3 * figures.mean_us() / std::max(1.0, figures.mean_expanded());
        const Figures* bucket = nullptr;
        for (const Figures& f : all) {
            if (f.name == "bucket") bucket = &f;
        }
        std::printf("  %-18s %11.2f %11.2f %11.2f %11.1f %9.1f %6.2f MB %9s\n",
                    figures.name.c_str(), figures.mean_us(), figures.quantile_us(0.5),
                    figures.quantile_us(0.99), figures.mean_expanded(), each,
                    static_cast<double>(bytes) / 1e6,
                    bucket ? std::to_string(bucket->mean_us() / figures.mean_us()).c_str() : "");
        rows.push_back({{"search", figures.name},
                        {"mean_us", figures.mean_us()},
                        {"p50_us", figures.quantile_us(0.5)},
                        {"p99_us", figures.quantile_us(0.99)},
                        {"expanded", figures.mean_expanded()},
                        {"ns_per_expansion", each},
                        {"scratch_bytes", bytes}});
        std::fflush(stdout);
        all.push_back(std::move(figures));
    };
    const auto compare = [&](const std::vector<Algorithm>& algorithms, int rounds) {
        std::vector<GridSearch> searches(algorithms.size());
        std::vector<Contender> contenders;
        for (std::size_t i = 0; i < algorithms.size(); ++i) {
            const Algorithm algorithm = algorithms[i];
            searches[i].prepare(map, algorithm);
            contenders.push_back({std::string(to_string(algorithm)),
                                  [&map, &search = searches[i], algorithm](const auto& q, auto& r) {
                                      return search.run(map, q, algorithm, r);
                                  }});
        }
        auto figures = measure(bench_map, contenders, rounds);
        for (std::size_t i = 0; i < figures.size(); ++i) {
            show(std::move(figures[i]), searches[i].bytes());  // what it has grown to
        }
    };
    CellSearch cells(map);
    const Contender yard{"astar-no-turns", [&](const auto& q, auto& r) { return cells.run(q, r); }};
    show(measure(bench_map, {yard}, 3).front(), 0);
    compare({Algorithm::kDijkstra, Algorithm::kAstar}, 1);
    compare({Algorithm::kBucket, Algorithm::kTurnJump}, 5);
    for (std::size_t i = 2; i < all.size(); ++i) {
        if (all[i].cost == all[1].cost) continue;
        std::fprintf(stderr, "%s and %s disagree on a cost\n", all[i].name.c_str(),
                     all[1].name.c_str());
        std::exit(1);
    }
    const Figures& yardstick = all.front();
    const Figures& bucket = all[all.size() - 2];
    const Figures& jump = all.back();
    const double bar_us = std::max(bucket.mean_expanded() * 0.060, bucket.mean_us()) / 10;
    std::printf(
        "  turn-jump %.2f us: %.2f of its bar (1/10 of bucket, %.2f us); 1/%.1f of A* "
        "without turn costs\n",
        jump.mean_us(), jump.mean_us() / bar_us, bar_us, yardstick.mean_us() / jump.mean_us());
    return {{"map", bench_map.name},      {"width", map.width()},
            {"height", map.height()},     {"problems", bench_map.problems.size()},
            {"map_bytes", map.bytes()},   {"build_us", build_us},
            {"turn_jump_bar_us", bar_us}, {"searches", rows}};
}

}  // namespace

nlohmann::json bench_grids(const std::string& folder) {
    nlohmann::json result = nlohmann::json::array();
    for (const BenchMap& map : folder.empty() ? generated_maps() : maps_in(folder)) {
        result.push_back(bench_map(map));
    }
    return result;
}

}  // namespace pulseline::bench
