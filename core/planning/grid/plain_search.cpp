#include "core/planning/grid/plain_search.hpp"

#include <algorithm>

#include "core/planning/grid/grid_trace.hpp"

namespace pulseline::planning {
void PlainSearch::prepare(const GridMap& map) {
    const std::size_t states = map.padded_cells() * kDirections;
    if (labels_.size() < states) labels_.resize(states);
}

std::size_t PlainSearch::bytes() const {
    return labels_.capacity() * sizeof(Label) + open_.capacity() * sizeof(Open);
}

void PlainSearch::reach(const GridMap& map, Cell cell, int heading, std::int64_t cost,
                        std::uint8_t by) {
    const std::size_t state = map.padded(cell) * kDirections + static_cast<std::size_t>(heading);
    Label& label = labels_[state];
    if (label.stamp == stamp_ && cost >= label.cost) return;
    label = {cost, stamp_, by};
    const std::int64_t left = use_bound_ ? (*bound_)(cell, heading) : 0;
    open_.push_back({cost + left, cost, static_cast<std::uint32_t>(state), cell});
    std::push_heap(open_.begin(), open_.end());
}

void PlainSearch::trace(const GridMap& map, const GridRequest& request, const Open& goal,
                        GridRoute& route) const {
    RouteTrace trace(request, route);
    Cell cell = goal.cell;
    auto heading = static_cast<int>(goal.state % kDirections);
    while (true) {
        const std::uint8_t by =
            labels_[map.padded(cell) * kDirections + static_cast<std::size_t>(heading)].by;
        if (by == kStart) break;
        trace.step_back(heading);
        if (by == kFirstStep) break;
        cell = next_to(cell, heading ^ 2);
        heading = by;
    }
    trace.finish();
}

SearchEnd PlainSearch::run(const GridMap& map, const GridRequest& request, bool use_bound,
                           GridRoute& route) {
    prepare(map);
    if (++stamp_ == 0) {
        std::fill(labels_.begin(), labels_.end(), Label{});
        stamp_ = 1;
    }
    open_.clear();
    use_bound_ = use_bound;
    const GridCost& cost = request.cost;
    bound_.emplace(request.goal, cost.step, cost.turn);
    if (!request.start_heading) {
        for (int d = 0; d < kDirections; ++d) {
            if ((map.moves(map.padded(request.start)) >> d & 1) == 0) continue;
            const Cell next = next_to(request.start, d);
            reach(map, next, d, cost.step * map.weight(next), kFirstStep);
        }
    } else if (!map.layers().is_blocked(*request.start_heading, request.start)) {
        reach(map, request.start, static_cast<int>(*request.start_heading), 0, kStart);
    }
    std::int64_t expanded = 0;
    while (!open_.empty()) {
        const Open top = open_.front();
        std::pop_heap(open_.begin(), open_.end());
        open_.pop_back();
        if (top.cost != labels_[top.state].cost) continue;  // reached at less since
        if (top.cell == request.goal) {
            route.expanded = expanded;
            route.cost = top.cost;
            trace(map, request, top, route);
            return SearchEnd::kFound;
        }
        if (++expanded % kCancelEvery == 0 && request.cancel &&
            request.cancel->load(std::memory_order_relaxed)) {
            return SearchEnd::kCancelled;
        }
        const auto heading = static_cast<int>(top.state % kDirections);
        const std::uint8_t moves = map.moves(map.padded(top.cell));
        for (int d = 0; d < kDirections; ++d) {
            if ((moves >> d & 1) == 0) continue;
            if (d != heading && (moves & GridMap::kMayTurn) == 0) continue;
            const Cell next = next_to(top.cell, d);
            reach(map, next, d,
                  top.cost + cost.step * map.weight(next) + (d == heading ? 0 : cost.turn),
                  static_cast<std::uint8_t>(heading));
        }
    }
    route.expanded = expanded;
    return SearchEnd::kNoRoute;
}

}  // namespace pulseline::planning
