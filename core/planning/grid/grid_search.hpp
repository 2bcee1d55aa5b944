#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/result.hpp"
#include "core/planning/grid/grid_cost.hpp"
#include "core/planning/grid/grid_map.hpp"

/// Direction-penalised search on an occupancy grid, 4-connected (Li 2022 eq. 10, corrected):
/// the state is (cell, direction of arrival), so every change of direction is seen and the result
/// is exact. Four ways to the same cost, from the simplest to the fastest.
namespace pulseline::planning {

enum class Algorithm : std::uint8_t {
    kDijkstra,  // plain search without a bound
    kAstar,     // plain A*: binary heap, 64-bit costs; takes every map and every cost
    kBucket,    // A* with a bucket queue; small integer costs
    kTurnJump,  // expands turning points only; uniform maps, no cheap turns
};
std::string_view to_string(Algorithm algorithm);

struct GridRequest {
    Cell start;
    Cell goal;
    std::optional<Direction> start_heading = std::nullopt;  // none: free
    GridCost cost = {};
    const std::atomic<bool>* cancel = nullptr;  // set by anyone
};
/// Expansions between two looks at GridRequest::cancel.
constexpr std::int64_t kCancelEvery = 1'000;

struct GridRoute {
    std::int64_t cost = 0;  // thousandths of k
    int length = 0;         // steps
    int turns = 0;          // changes of direction, one from the start heading included
    std::int64_t expanded = 0;
    Algorithm algorithm = Algorithm::kTurnJump;  // that answered
    std::vector<Cell> corners;                   // start, every cell with a turn, goal

    std::vector<Cell> cells() const;  // every cell from start to goal
    double cost_in_k() const { return static_cast<double>(cost) / kCostUnit; }
};

enum class SearchEnd : std::uint8_t {
    kFound,
    kNoRoute,
    kCancelled,
    kUnfit,  // not for this search: another one must answer
};

/// Searches with all their memory, for one thread. After a first query on maps of a size (or
/// prepare()) no query allocates, as long as `route` is used again too.
class GridSearch {
public:
    GridSearch();
    ~GridSearch();
    GridSearch(GridSearch&&) noexcept;
    GridSearch& operator=(GridSearch&&) noexcept;

    /// Answers with `wanted`, or with the next simpler search where its conditions do not hold.
    /// REQUIRES: check(map, request) passed.
    SearchEnd run(const GridMap& map, const GridRequest& request, Algorithm wanted,
                  GridRoute& route);

    /// Takes the memory that queries with `wanted` on maps of this size need.
    void prepare(const GridMap& map, Algorithm wanted);
    std::size_t bytes() const;

private:
    struct Searches;
    std::unique_ptr<Searches> searches_;
};

/// Errors: outside_grid (kInvalid, field /start or /goal), routing_cost_invalid.
Status check(const GridMap& map, const GridRequest& request);

/// One query with an explained failure: those of check(), no_route {blocked_by: start | goal |
/// obstacles}, cancelled.
Result<GridRoute> plan_grid(const GridMap& map, const GridRequest& request,
                            Algorithm wanted = Algorithm::kTurnJump);

}  // namespace pulseline::planning
