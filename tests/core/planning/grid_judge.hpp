#pragma once

#include <limits>
#include <queue>
#include <tuple>
#include <vector>

#include "core/planning/grid/grid_search.hpp"

/// What grid searches are held against: nothing clever, no code shared with them.
namespace pulseline::planning {

constexpr std::int64_t kUnreached = std::numeric_limits<std::int64_t>::max();

inline plant::OccupancyGrid grid_of(int width, int height, double resolution_m = 1) {
    plant::OccupancyGrid grid;
    grid.width = width;
    grid.height = height;
    grid.resolution_m = resolution_m;
    grid.occupied.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    return grid;
}

/// Whether the layers allow a step from a cell along d.
inline bool may_step(const GridLayers& layers, Cell from, int d) {
    const auto i = static_cast<std::size_t>(d);
    const Cell to{from.col + kStep[i].col, from.row + kStep[i].row};
    return layers.inside(to) && !layers.blocked[i].test(from) && !layers.blocked[i].test(to) &&
           (layers.no_exit[i].empty() || !layers.no_exit[i].test(from));
}

inline std::int64_t weight_of(const GridLayers& layers, Cell cell) {
    return layers.weight.empty() ? 1 : layers.weight[layers.index(cell)];
}

/// Dijkstra over (cell, direction); kUnreached without a route.
inline std::int64_t judge(const GridLayers& layers, const GridRequest& request) {
    const auto state = [&](Cell cell, int d) {
        return layers.index(cell) * 4 + static_cast<std::size_t>(d);
    };
    if (request.start == request.goal) {
        for (std::size_t d = 0; d < 4; ++d) {
            if (!layers.blocked[d].test(request.start)) return 0;
        }
        return kUnreached;
    }
    const auto cells = static_cast<std::size_t>(layers.width) * layers.height;
    std::vector<std::int64_t> best(cells * 4, kUnreached);
    using Entry = std::tuple<std::int64_t, int, int, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto reach = [&](Cell cell, int d, std::int64_t cost) {
        if (cost >= best[state(cell, d)]) return;
        best[state(cell, d)] = cost;
        open.push({cost, cell.col, cell.row, d});
    };
    const auto drive = [&](Cell from, int d, std::int64_t cost) {
        if (!may_step(layers, from, d)) return;
        const Cell to{from.col + kStep[static_cast<std::size_t>(d)].col,
                      from.row + kStep[static_cast<std::size_t>(d)].row};
        reach(to, d, cost + request.cost.step * weight_of(layers, to));
    };
    if (request.start_heading) {
        const int d = static_cast<int>(*request.start_heading);
        if (!layers.is_blocked(*request.start_heading, request.start)) reach(request.start, d, 0);
    } else {
        for (int d = 0; d < 4; ++d) drive(request.start, d, 0);  // the first step is no turn
    }
    while (!open.empty()) {
        const auto [cost, col, row, d] = open.top();
        open.pop();
        const Cell cell{col, row};
        if (cost > best[state(cell, d)]) continue;
        if (cell == request.goal) return cost;
        for (int e = 0; e < 4; ++e) {
            if (e != d && layers.no_turn.test(cell)) continue;
            drive(cell, e, cost + (e == d ? 0 : request.cost.turn));
        }
    }
    return kUnreached;
}

/// What is wrong with a route, step by step over the layers; empty when nothing is.
inline std::string fault(const GridLayers& layers, const GridRequest& request,
                         const GridRoute& route) {
    const auto cells = route.cells();
    if (cells.empty() || !(cells.front() == request.start) || !(cells.back() == request.goal)) {
        return "does not lead from start to goal";
    }
    int heading = request.start_heading ? static_cast<int>(*request.start_heading) : -1;
    std::int64_t cost = 0;
    int turns = 0;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        int d = 0;
        while (d < 4 &&
               !(Cell{cells[i - 1].col + kStep[static_cast<std::size_t>(d)].col,
                      cells[i - 1].row + kStep[static_cast<std::size_t>(d)].row} == cells[i])) {
            ++d;
        }
        if (d == 4) return "jumps";
        if (!may_step(layers, cells[i - 1], d)) return "drives where it may not";
        if (heading >= 0 && d != heading) {
            if (layers.no_turn.test(cells[i - 1])) return "turns where it may not";
            cost += request.cost.turn;
            ++turns;
        }
        cost += request.cost.step * weight_of(layers, cells[i]);
        heading = d;
    }
    if (turns != route.turns) return "miscounts its turns";
    if (route.length + 1 != static_cast<int>(cells.size())) return "miscounts its length";
    if (cost != route.cost) return "miscounts its cost";
    return {};
}

}  // namespace pulseline::planning
