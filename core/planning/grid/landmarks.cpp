#include "core/planning/grid/landmarks.hpp"

#include <algorithm>

namespace pulseline::planning {
namespace {

/// The grid with a blocked border, one byte a cell, for breadth-first searches.
class Floor {
public:
    explicit Floor(const BitGrid& blocked)
        : stride_(static_cast<std::size_t>(blocked.width()) + 2),
          free_(stride_ * (static_cast<std::size_t>(blocked.height()) + 2), 0),
          steps_{1, static_cast<std::ptrdiff_t>(stride_), -1,
                 -static_cast<std::ptrdiff_t>(stride_)} {
        for (int row = 0; row < blocked.height(); ++row) {
            for (int col = 0; col < blocked.width(); ++col) {
                free_[padded({col, row})] = blocked.test({col, row}) ? 0 : 1;
            }
        }
    }

    std::size_t padded(Cell cell) const {
        return (static_cast<std::size_t>(cell.row) + 1) * stride_ +
               static_cast<std::size_t>(cell.col) + 1;
    }
    std::size_t cells() const { return free_.size(); }
    bool free(std::size_t cell) const { return free_[cell] != 0; }

    /// Steps from `from`; the cells in the order reached stay in `order`.
    void flood(std::size_t from, std::vector<std::uint16_t>& steps,
               std::vector<std::uint32_t>& order) const {
        order.clear();
        order.push_back(static_cast<std::uint32_t>(from));
        steps[from] = 0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::size_t cell = order[i];
            const auto next = std::min<int>(steps[cell] + 1, Landmarks::kFarthest);
            for (const std::ptrdiff_t step : steps_) {
                const std::size_t to = cell + static_cast<std::size_t>(step);
                if (!free(to) || steps[to] != Landmarks::kUnreached) continue;
                steps[to] = static_cast<std::uint16_t>(next);
                order.push_back(static_cast<std::uint32_t>(to));
            }
        }
    }

private:
    std::size_t stride_;
    std::vector<std::uint8_t> free_;
    std::ptrdiff_t steps_[kDirections];
};

/// A cell of the largest connected part; cells() when nothing is free.
std::size_t somewhere_in_the_largest_part(const Floor& floor, std::vector<std::uint16_t>& steps,
                                          std::vector<std::uint32_t>& order) {
    std::size_t best = floor.cells();
    std::size_t most = 0;
    for (std::size_t cell = 0; cell < floor.cells(); ++cell) {
        if (!floor.free(cell) || steps[cell] != Landmarks::kUnreached) continue;
        floor.flood(cell, steps, order);
        if (order.size() <= most) continue;
        most = order.size();
        best = order.back();  // the farthest
    }
    return best;
}

}  // namespace

Landmarks::Landmarks(const BitGrid& blocked) {
    const Floor floor(blocked);
    CellWays unreached;
    std::fill(std::begin(unreached.to), std::end(unreached.to), kUnreached);
    ways_.assign(floor.cells(), unreached);
    std::vector<std::uint16_t> steps(floor.cells(), kUnreached);
    std::vector<std::uint32_t> order;
    order.reserve(floor.cells());
    std::size_t landmark = somewhere_in_the_largest_part(floor, steps, order);
    if (landmark == floor.cells()) return;
    std::vector<std::uint16_t> nearest(floor.cells(), kUnreached);  // way to the nearest landmark
    for (int i = 0; i < kCount; ++i) {
        std::fill(steps.begin(), steps.end(), kUnreached);
        floor.flood(landmark, steps, order);
        std::uint16_t farthest = 0;
        for (const std::uint32_t cell : order) {
            ways_[cell].to[i] = steps[cell];
            nearest[cell] = std::min(nearest[cell], steps[cell]);
            if (nearest[cell] < farthest) continue;
            farthest = nearest[cell];
            landmark = cell;
        }
    }
}

void Landmarks::freed(const BitGrid& blocked, Cell cell) {
    const auto padded = [&](Cell c) {
        return (static_cast<std::size_t>(c.row) + 1) *
                   (static_cast<std::size_t>(blocked.width()) + 2) +
               static_cast<std::size_t>(c.col) + 1;
    };
    const auto free = [&](Cell c) { return blocked.inside(c) && !blocked.test(c); };
    std::vector<Cell> open;
    for (int i = 0; i < kCount; ++i) {
        std::uint16_t least = kUnreached;
        for (const Cell step : kStep) {
            const Cell next{cell.col + step.col, cell.row + step.row};
            if (free(next)) least = std::min(least, ways_[padded(next)].to[i]);
        }
        const auto after = [](std::uint16_t steps) {
            return static_cast<std::uint16_t>(std::min<int>(steps + 1, kFarthest));
        };
        ways_[padded(cell)].to[i] = least == kUnreached ? kUnreached : after(least);
        if (least == kUnreached) continue;
        open.assign(1, cell);
        for (std::size_t k = 0; k < open.size(); ++k) {
            const Cell at = open[k];
            const std::uint16_t most = after(ways_[padded(at)].to[i]);
            for (const Cell step : kStep) {
                const Cell next{at.col + step.col, at.row + step.row};
                if (!free(next) || ways_[padded(next)].to[i] <= most) continue;
                ways_[padded(next)].to[i] = most;
                open.push_back(next);
            }
        }
    }
}

}  // namespace pulseline::planning
