#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/result.hpp"
#include "core/planning/grid/grid.hpp"
#include "core/planning/search/routing_cost.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// Costs as integers of a thousandth of k (kCostUnit).
struct GridCost {
    std::int64_t step = 10'000;  // straight into the next cell
    std::int64_t turn = 10'000;  // on top, after a change of direction; step + turn >= 0
    friend bool operator==(const GridCost&, const GridCost&) = default;
};

/// Cells of length 1 and k_diff for a cell entered after a change of direction.
Result<GridCost> unit_cell_cost(double k_same, double k_diff);
/// Cells of a hall's grid: k_same x length + the fixed charge of a plant's routing cost.
Result<GridCost> hall_cost(const plant::RoutingCost& cost, double resolution_m);

/// Lower bound of the cost from a place and heading to the goal, `T` an integer type that holds it:
/// the exact cost on an empty floor (README.md), hence consistent. With cheap turns
/// (turn < 0) every step may cost as little as step + turn, and turns are not counted.
template <class T>
class FloorBound {
public:
    FloorBound(Cell goal, T step, T turn)
        : goal_(goal), step_(turn < 0 ? step + turn : step), turn_(turn < 0 ? 0 : turn) {}

    /// `least_steps`: what else is known of the way there. Steps and turns are bounded each for
    /// itself, so that the better of two bounds of the steps is consistent, too.
    T operator()(Cell at, int heading, int least_steps = 0) const {
        const int dx = goal_.col - at.col;
        const int dy = goal_.row - at.row;
        return step_ * static_cast<T>(std::max(std::abs(dx) + std::abs(dy), least_steps)) +
               turn_ * static_cast<T>(least_turns(heading, dx, dy));
    }
    T per_step() const { return step_; }
    T per_turn() const { return turn_; }

    /// Least changes of direction with (dx, dy) to go: one more behind than ahead, one more beside.
    static int least_turns(int heading, int dx, int dy) {
        const int along = (heading & 1) != 0 ? dy : dx;
        const int beside = (heading & 1) != 0 ? dx : dy;
        const int ahead = heading < 2 ? along : -along;
        return static_cast<int>(beside != 0) + static_cast<int>(ahead < 0);
    }

private:
    Cell goal_;
    T step_;
    T turn_;
};

}  // namespace pulseline::planning
