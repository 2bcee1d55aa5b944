#include "core/planning/grid/grid_search.hpp"

#include <limits>
#include <string>

#include "core/planning/grid/bucket_search.hpp"
#include "core/planning/grid/plain_search.hpp"
#include "core/planning/grid/turn_jump_search.hpp"

namespace pulseline::planning {

std::string_view to_string(Algorithm algorithm) {
    switch (algorithm) {
        case Algorithm::kDijkstra:
            return "dijkstra";
        case Algorithm::kAstar:
            return "astar";
        case Algorithm::kBucket:
            return "bucket";
        case Algorithm::kTurnJump:
            return "turn-jump";
    }
    return "";
}

std::vector<Cell> GridRoute::cells() const {
    std::vector<Cell> all;
    all.reserve(static_cast<std::size_t>(length) + 1);
    if (corners.empty()) return all;
    all.push_back(corners.front());
    for (const Cell corner : corners) {
        while (!(all.back() == corner)) {
            const Cell at = all.back();
            const auto towards = [](int from, int to) { return (to > from) - (to < from); };
            all.push_back(
                {at.col + towards(at.col, corner.col), at.row + towards(at.row, corner.row)});
        }
    }
    return all;
}

namespace {

// Expansions that are spent on a way to beat; without one, a way through the final assembly took
// 38,000.
constexpr std::int64_t kBoundWork = 10'000;

}  // namespace

struct GridSearch::Searches {
    TurnJumpSearch turn_jump;
    BucketSearch<std::uint32_t> bucket;
    BucketSearch<std::uint64_t> wide_bucket;
    PlainSearch plain;
    GridRoute better;
};

GridSearch::GridSearch() : searches_(std::make_unique<Searches>()) {}
GridSearch::~GridSearch() = default;
GridSearch::GridSearch(GridSearch&&) noexcept = default;
GridSearch& GridSearch::operator=(GridSearch&&) noexcept = default;

SearchEnd GridSearch::run(const GridMap& map, const GridRequest& request, Algorithm wanted,
                          GridRoute& route) {
    route.cost = 0;
    route.length = 0;
    route.turns = 0;
    route.expanded = 0;
    route.algorithm = wanted;
    route.corners.clear();
    if (request.start == request.goal) {
        if (map.nowhere(request.start)) return SearchEnd::kNoRoute;
        route.corners.push_back(request.start);
        return SearchEnd::kFound;
    }
    SearchEnd end = SearchEnd::kUnfit;
    std::optional<std::int64_t> below;
    if (wanted == Algorithm::kTurnJump && map.jumps_pay()) {
        auto& jumps = searches_->turn_jump;
        jumps.limit_work(map.uniform() ? std::numeric_limits<std::int64_t>::max() : kBoundWork);
        end = jumps.run(map, request, route);
        // Found over plain cells only: what the bucket search has to beat.
        if (!map.uniform() && end == SearchEnd::kFound) below = route.cost;
        if (!map.uniform()) end = SearchEnd::kUnfit;
    }
    if (end == SearchEnd::kUnfit && wanted >= Algorithm::kBucket) {
        GridRoute& better = searches_->better;
        end = searches_->bucket.run(map, request, better, below);
        if (end == SearchEnd::kUnfit) {
            end = searches_->wide_bucket.run(map, request, better, below);
        }
        if (end == SearchEnd::kFound) {
            route = better;  // a copy: both keep their room
            route.algorithm = Algorithm::kBucket;
        } else if (end == SearchEnd::kNoRoute && below) {
            end = SearchEnd::kFound;
        }
    }
    if (end == SearchEnd::kUnfit) {
        route.algorithm = wanted == Algorithm::kDijkstra ? wanted : Algorithm::kAstar;
        end = searches_->plain.run(map, request, wanted != Algorithm::kDijkstra, route);
    }
    return end;
}

void GridSearch::prepare(const GridMap& map, Algorithm wanted) {
    if (wanted == Algorithm::kTurnJump && map.jumps_pay()) {
        searches_->turn_jump.prepare(map);
    } else if (wanted >= Algorithm::kBucket) {
        searches_->bucket.prepare(map);
    } else {
        searches_->plain.prepare(map);
    }
}

std::size_t GridSearch::bytes() const {
    return searches_->turn_jump.bytes() + searches_->bucket.bytes() +
           searches_->wide_bucket.bytes() + searches_->plain.bytes();
}

Status check(const GridMap& map, const GridRequest& request) {
    const std::pair<const char*, Cell> ends[] = {{"/start", request.start},
                                                 {"/goal", request.goal}};
    for (const auto& [field, cell] : ends) {
        if (map.inside(cell)) continue;
        return fail(Errc::kInvalid, "outside_grid",
                    "The cell lies outside the grid. Choose one inside.", field,
                    {{"col", std::int64_t{cell.col}}, {"row", std::int64_t{cell.row}}});
    }
    if (request.cost.step < 0 || request.cost.step + request.cost.turn < 0) {
        return fail(Errc::kInvalid, "routing_cost_invalid",
                    "The cost of a step must be at least 0, with and without a turn.");
    }
    return {};
}

Result<GridRoute> plan_grid(const GridMap& map, const GridRequest& request, Algorithm wanted) {
    if (const auto ok = check(map, request); !ok) return fail(ok.error());
    GridRoute route;
    const SearchEnd end = GridSearch().run(map, request, wanted, route);
    if (end == SearchEnd::kFound) return route;
    if (end == SearchEnd::kCancelled) {
        return fail(Errc::kTimeout, "cancelled", "The search was stopped before it found a route.");
    }
    const char* by = map.nowhere(request.start)  ? "start"
                     : map.nowhere(request.goal) ? "goal"
                                                 : "obstacles";
    return fail(Errc::kUnreachable, "no_route",
                "No free way leads there for this vehicle. Choose another target or clear the "
                "floor.",
                {}, {{"blocked_by", std::string(by)}});
}

}  // namespace pulseline::planning
