#include "core/planning/grid/octile_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pulseline::planning {
namespace {

constexpr std::uint8_t kFirstStep = OctileSearch::kHeadings;  // out of the start, heading free
constexpr std::uint8_t kStart = kFirstStep + 1;

bool is_free(const GridMap& map, Cell cell) {
    return map.inside(cell) &&
           std::none_of(map.layers().blocked.begin(), map.layers().blocked.end(),
                        [&](const BitGrid& b) { return b.test(cell); });
}

Cell moved(Cell cell, int heading, int sign) {
    const Cell step = OctileSearch::kOctileStep[heading];
    return {cell.col + sign * step.col, cell.row + sign * step.row};
}

}  // namespace

std::int64_t OctileSearch::step_cost(const GridCost& cost, int heading) {
    if (heading % 2 == 0) return cost.step;
    return std::llround(static_cast<double>(cost.step) * std::numbers::sqrt2);
}

int OctileSearch::eighths(int heading, int next) {
    const int turn = std::abs(next - heading);
    return std::min(turn, kHeadings - turn);
}

bool OctileSearch::may_step(const GridMap& map, Cell from, int heading) {
    const Cell step = kOctileStep[heading];
    return is_free(map, from) && is_free(map, moved(from, heading, 1)) &&
           (heading % 2 == 0 || (is_free(map, {from.col + step.col, from.row}) &&
                                 is_free(map, {from.col, from.row + step.row})));
}

void OctileSearch::reach(const GridMap& map, const OctileRequest& request, Cell cell, int heading,
                         std::int64_t cost, std::uint8_t by) {
    Label& label = labels_[map.padded(cell) * kHeadings + static_cast<std::size_t>(heading)];
    if (label.stamp == stamp_ && cost >= label.cost) return;
    label = {cost, stamp_, by};
    // As many diagonal steps as help, the rest straight: no way is shorter.
    const std::int64_t dx = std::abs(request.goal.col - cell.col);
    const std::int64_t dy = std::abs(request.goal.row - cell.row);
    const std::int64_t diagonal = std::min(dx, dy);
    const std::int64_t bound = diagonal * step_cost(request.cost, 1) +
                               (std::max(dx, dy) - diagonal) * step_cost(request.cost, 0);
    open_.push_back({cost + bound, cost, cell, heading});
    std::push_heap(open_.begin(), open_.end());
}

void OctileSearch::trace(const GridMap& map, const OctileRequest& request, const Open& goal,
                         OctileRoute& route) const {
    Cell cell = goal.cell;
    int heading = goal.heading;
    int next = -1;
    while (true) {
        const std::uint8_t by =
            labels_[map.padded(cell) * kHeadings + static_cast<std::size_t>(heading)].by;
        route.cells.push_back(cell);
        if (by == kStart) break;
        if (next >= 0) route.turn_eighths += eighths(heading, next);
        route.length += heading % 2 == 0 ? 1 : std::numbers::sqrt2;
        next = heading;
        cell = moved(cell, heading, -1);
        if (by == kFirstStep) {
            route.cells.push_back(cell);
            break;
        }
        heading = by;
    }
    if (next >= 0 && request.start_heading) {
        route.turn_eighths += eighths(*request.start_heading, next);
    }
    std::reverse(route.cells.begin(), route.cells.end());
}

SearchEnd OctileSearch::run(const GridMap& map, const OctileRequest& request, OctileRoute& route) {
    route.cost = 0;
    route.length = 0;
    route.turn_eighths = 0;
    route.expanded = 0;
    route.cells.clear();
    if (!is_free(map, request.start) || !is_free(map, request.goal)) return SearchEnd::kNoRoute;
    if (request.start == request.goal) {
        route.cells.push_back(request.start);
        return SearchEnd::kFound;
    }
    const std::size_t states = map.padded_cells() * kHeadings;
    if (labels_.size() < states) labels_.resize(states);
    if (++stamp_ == 0) {
        std::fill(labels_.begin(), labels_.end(), Label{});
        stamp_ = 1;
    }
    open_.clear();
    if (request.start_heading) {
        reach(map, request, request.start, *request.start_heading, 0, kStart);
    } else {
        for (int d = 0; d < kHeadings; ++d) {
            if (!may_step(map, request.start, d)) continue;
            reach(map, request, moved(request.start, d, 1), d, step_cost(request.cost, d),
                  kFirstStep);
        }
    }
    while (!open_.empty()) {
        const Open top = open_.front();
        std::pop_heap(open_.begin(), open_.end());
        open_.pop_back();
        const std::size_t state =
            map.padded(top.cell) * kHeadings + static_cast<std::size_t>(top.heading);
        if (top.cost != labels_[state].cost) continue;  // reached at less since
        if (top.cell == request.goal) {
            route.cost = top.cost;
            trace(map, request, top, route);
            return SearchEnd::kFound;
        }
        if (++route.expanded % kCancelEvery == 0 && request.cancel &&
            request.cancel->load(std::memory_order_relaxed)) {
            return SearchEnd::kCancelled;
        }
        for (int d = 0; d < kHeadings; ++d) {
            if (!may_step(map, top.cell, d)) continue;
            const std::int64_t turn = request.cost.turn * eighths(top.heading, d) / 2;
            reach(map, request, moved(top.cell, d, 1), d,
                  top.cost + step_cost(request.cost, d) + turn,
                  static_cast<std::uint8_t>(top.heading));
        }
    }
    return SearchEnd::kNoRoute;
}

}  // namespace pulseline::planning
