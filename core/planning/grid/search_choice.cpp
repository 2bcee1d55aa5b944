#include "core/planning/grid/search_choice.hpp"

#include <algorithm>
#include <vector>

#include "core/planning/grid/bucket_search.hpp"
#include "core/planning/grid/turn_jump_search.hpp"

namespace pulseline::planning {
namespace {

constexpr std::size_t kSmall_cells = 10'000;
constexpr std::size_t kCells = 64;             // looked at as ends of problems
constexpr std::size_t kProblems = 3;           // the farthest of them are tried
constexpr std::int64_t kMostWork = 1'000'000;  // of one try, about 50 ms

struct Problem {
    Cell start;
    Cell goal;
};

/// Cells of the largest connected part spread over the map, always the same ones.
std::vector<Cell> spread_cells(const GridMap& map) {
    std::vector<Cell> cells;
    std::uint32_t number = 1;
    for (std::size_t tries = 0; tries < 20 * kCells && cells.size() < kCells; ++tries) {
        number = number * 1664525u + 1013904223u;  // Numerical Recipes' generator
        const auto at = static_cast<std::uint64_t>(number >> 4) %
                        (static_cast<std::uint64_t>(map.width()) * map.height());
        const Cell cell{static_cast<int>(at % static_cast<std::uint64_t>(map.width())),
                        static_cast<int>(at / static_cast<std::uint64_t>(map.width()))};
        const bool reached = map.landmarks().at(map.padded(cell))[0] != Landmarks::kUnreached;
        if (reached) cells.push_back(cell);
    }
    return cells;
}

std::vector<Problem> far_problems(const GridMap& map) {
    const auto cells = spread_cells(map);
    std::vector<Problem> problems;
    for (std::size_t i = 0; i + 1 < cells.size(); i += 2) {
        problems.push_back({cells[i], cells[i + 1]});
    }
    std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
        return manhattan(a.start, a.goal) > manhattan(b.start, b.goal);
    });
    if (problems.size() > kProblems) problems.resize(kProblems);
    return problems;
}

}  // namespace

bool jumps_pay(const GridMap& map) {
    const auto area =
        static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height());
    if (area < kSmall_cells) return true;
    TurnJumpSearch jump;
    jump.limit_work(kMostWork);
    BucketSearch<std::uint32_t> bucket;
    GridRoute route;
    std::int64_t jump_work = 0;
    std::int64_t bucket_work = 0;
    for (const Problem& problem : far_problems(map)) {
        const GridRequest request{problem.start, problem.goal};
        if (jump.run(map, request, route) == SearchEnd::kUnfit) return true;
        bucket.limit_work(jump.work());
        const SearchEnd end = bucket.run(map, request, route);
        if (end == SearchEnd::kUnfit) return true;
        jump_work += jump.work();
        // Stopped: it takes that much at least.
        bucket_work += end == SearchEnd::kCancelled ? jump.work() + 1 : route.expanded;
    }
    return jump_work <= bucket_work;
}

}  // namespace pulseline::planning
