#include "core/planning/grid_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>

#include "core/planning/road_search.hpp"

namespace pulseline::planning {
namespace {

constexpr std::array<Cell, kDirections> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
constexpr std::int64_t kUnreached = std::numeric_limits<std::int64_t>::max();
// Costs of a cell beyond this could overflow on the largest grid.
constexpr double kLargestCost = 1e9;

Result<GridCost> rounded(double step, double turn) {
    for (const double value : {step, turn}) {
        if (!std::isfinite(value) || std::abs(value) > kLargestCost) {
            return fail(Errc::kInvalid, "routing_cost_invalid",
                        "The routing costs k_same and k_diff must be between 0 and 1e9.");
        }
    }
    GridCost cost;
    cost.step = std::llround(step * kCostUnit);
    cost.turn = std::max(-cost.step, std::int64_t{std::llround(turn * kCostUnit)});
    return cost;
}

/// Least changes of direction on an empty grid for a vehicle that heads `d` and has (dx, dy) to go.
int least_turns(int d, int dx, int dy) {
    const Cell step = kStep[static_cast<std::size_t>(d)];
    const int ahead = dx * step.col + dy * step.row;
    const int beside = std::abs(dx * step.row) + std::abs(dy * step.col);
    if (beside == 0) return ahead >= 0 ? 0 : 1;
    return ahead >= 0 ? 1 : 2;
}

class GridSearch {
public:
    GridSearch(const GridLayers& layers, const GridRequest& request)
        : layers_(layers), request_(request) {
        const std::size_t states = layers.blocked[0].size() * kDirections;
        cost_.assign(states, kUnreached);
        before_.assign(states, kNone);
    }

    Result<GridRoute> run() {
        if (request_.start == request_.goal) return arrived_at_once();
        begin();
        while (!open_.empty()) {
            const Open top = open_.top();
            open_.pop();
            if (top.cost != cost_[top.state]) continue;
            const Cell cell = cell_of(top.state);
            if (cell == request_.goal) return route_to(top.state);
            ++expanded_;
            expand(cell, static_cast<int>(top.state % kDirections), top.state, top.cost);
        }
        return no_route();
    }

private:
    static constexpr std::uint8_t kNone = 255;   // stands at the start
    static constexpr std::uint8_t kFirst = 254;  // first step with free heading: no turn

    struct Open {
        std::int64_t estimate;
        std::int64_t cost;
        std::size_t state;
        bool operator<(const Open& other) const {  // greatest first; of equals the farthest on
            if (estimate != other.estimate) return estimate > other.estimate;
            return cost < other.cost;
        }
    };

    bool blocked(int d, Cell cell) const {
        return !layers_.inside(cell) ||
               layers_.blocked[static_cast<std::size_t>(d)][layers_.index(cell)] != 0;
    }
    Cell cell_of(std::size_t state) const {
        const auto width = static_cast<std::size_t>(layers_.width);
        const std::size_t index = state / kDirections;
        return {static_cast<int>(index % width), static_cast<int>(index / width)};
    }

    void begin() {
        if (request_.start_heading) {
            const int d = static_cast<int>(*request_.start_heading);
            if (!blocked(d, request_.start)) reach(request_.start, d, 0, kNone);
            return;
        }
        for (int d = 0; d < kDirections; ++d) {
            const Cell step = kStep[static_cast<std::size_t>(d)];
            const Cell next{request_.start.col + step.col, request_.start.row + step.row};
            if (blocked(d, request_.start) || blocked(d, next)) continue;
            reach(next, d, request_.cost.step, kFirst);
        }
    }

    std::int64_t bound(Cell cell, int d) const {
        const int dx = request_.goal.col - cell.col;
        const int dy = request_.goal.row - cell.row;
        const std::int64_t steps = std::abs(dx) + std::abs(dy);
        const GridCost& cost = request_.cost;
        if (cost.turn < 0) return (cost.step + cost.turn) * steps;
        return cost.step * steps + cost.turn * least_turns(d, dx, dy);
    }

    void reach(Cell cell, int d, std::int64_t cost, std::uint8_t before) {
        const std::size_t state = layers_.index(cell) * kDirections + static_cast<std::size_t>(d);
        if (cost >= cost_[state]) return;
        cost_[state] = cost;
        before_[state] = before;
        open_.push({cost + bound(cell, d), cost, state});
    }

    void expand(Cell cell, int heading, std::size_t state, std::int64_t cost) {
        const bool may_turn = layers_.no_turn[state / kDirections] == 0;
        for (int d = 0; d < kDirections; ++d) {
            if (d != heading && (!may_turn || blocked(d, cell))) continue;
            const Cell step = kStep[static_cast<std::size_t>(d)];
            const Cell next{cell.col + step.col, cell.row + step.row};
            if (blocked(d, next)) continue;
            const std::int64_t turn = d == heading ? 0 : request_.cost.turn;
            reach(next, d, cost + request_.cost.step + turn, static_cast<std::uint8_t>(heading));
        }
    }

    GridRoute route_to(std::size_t state) const {
        GridRoute route;
        route.cost = static_cast<double>(cost_[state]) / kCostUnit;
        route.expanded = expanded_;
        Cell cell = cell_of(state);
        int d = static_cast<int>(state % kDirections);
        route.cells.push_back(cell);
        while (true) {
            const int before =
                before_[layers_.index(cell) * kDirections + static_cast<std::size_t>(d)];
            if (before == kNone) break;
            const Cell step = kStep[static_cast<std::size_t>(d)];
            cell = {cell.col - step.col, cell.row - step.row};
            ++route.length;
            route.cells.push_back(cell);
            if (before == kFirst) break;
            route.turns += before != d ? 1 : 0;
            d = before;
        }
        std::reverse(route.cells.begin(), route.cells.end());
        return route;
    }

    bool nowhere(Cell cell) const {
        for (int d = 0; d < kDirections; ++d) {
            if (!blocked(d, cell)) return false;
        }
        return true;
    }

    Result<GridRoute> arrived_at_once() const {
        if (nowhere(request_.start)) return no_route();
        GridRoute route;
        route.cells = {request_.start};
        return route;
    }

    tl::unexpected<Error> no_route() const {
        const char* by = nowhere(request_.start)  ? "start"
                         : nowhere(request_.goal) ? "goal"
                                                  : "obstacles";
        return fail(Errc::kUnreachable, "no_route",
                    "No free way leads there for this vehicle. Choose another target or clear the "
                    "floor.",
                    {}, {{"blocked_by", std::string(by)}});
    }

    const GridLayers& layers_;
    const GridRequest& request_;
    std::vector<std::int64_t> cost_;
    std::vector<std::uint8_t> before_;  // direction before the step that led here
    std::priority_queue<Open> open_;
    std::int64_t expanded_ = 0;
};

}  // namespace

Result<GridCost> unit_cell_cost(double k_same, double k_diff) {
    return check({k_same, k_diff, 1, 0}).and_then([&] { return rounded(k_same, k_diff - k_same); });
}

Result<GridCost> hall_cost(const plant::RoutingCost& cost, double resolution_m) {
    return check(cost).and_then([&] {
        return rounded(cost.k_same * resolution_m,
                       (cost.k_diff - cost.k_same) * cost.reference_step_m);
    });
}

Result<GridRoute> plan_grid(const GridLayers& layers, const GridRequest& request) {
    const std::pair<const char*, Cell> ends[] = {{"/start", request.start},
                                                 {"/goal", request.goal}};
    for (const auto& [field, cell] : ends) {
        if (layers.inside(cell)) continue;
        return fail(Errc::kInvalid, "outside_grid",
                    "The cell lies outside the grid. Choose one inside.", field,
                    {{"col", std::int64_t{cell.col}}, {"row", std::int64_t{cell.row}}});
    }
    if (request.cost.step < 0 || request.cost.step + request.cost.turn < 0) {
        return fail(Errc::kInvalid, "routing_cost_invalid",
                    "The cost of a step must be at least 0, with and without a turn.");
    }
    return GridSearch(layers, request).run();
}

}  // namespace pulseline::planning
