#pragma once

#include <cstdint>
#include <vector>

#include "core/planning/grid/bit_grid.hpp"

namespace pulseline::planning {

/// Lower bounds of the way between cells of a uniform grid, from the ways to a few far cells (the
/// landmarks of Goldberg and Harrelson, "Computing the Shortest Path: A* Search Meets Graph
/// Theory", SODA 2005): |D(a) - D(b)| steps at least, D being the steps to a landmark. Where walls
/// force detours this is far above the Manhattan distance.
///
/// All that the bound needs of D is that it differs by at most 1 between free neighbours. So an
/// edit that blocks a cell changes nothing (D only gets too low), and one that frees a cell lowers
/// D around it until that holds again.
class Landmarks {
public:
    static constexpr int kCount = 4;
    using Ways = std::uint16_t[kCount];
    static constexpr std::uint16_t kUnreached = 0xFFFF;
    static constexpr std::uint16_t kFarthest = 0xFFFE;  // ways beyond are cut off, bounds stay true

    /// Chooses landmarks far from each other in the largest connected part.
    explicit Landmarks(const BitGrid& blocked);

    /// By padded cell: (row + 1) x (width + 2) + col + 1.
    const Ways& at(std::size_t padded) const { return ways_.data()[padded].to; }
    /// One was reached from the landmarks and the other not: no way joins them.
    bool separate(std::size_t a, std::size_t b) const {
        return (at(a)[0] == kUnreached) != (at(b)[0] == kUnreached);
    }
    /// Steps between two cells, at least.
    static int least_steps(const Ways& a, const Ways& b) {
        int most = 0;
        for (int i = 0; i < kCount; ++i) {
            const int d = int{a[i]} - int{b[i]};
            const int m = d < 0 ? -d : d;
            most = m > most ? m : most;
        }
        return most;
    }

    /// The cell became free; `blocked` is the map after the edit.
    void freed(const BitGrid& blocked, Cell cell);

    std::size_t bytes() const { return ways_.size() * sizeof(CellWays); }

private:
    struct CellWays {
        Ways to;
    };
    std::vector<CellWays> ways_;
};

}  // namespace pulseline::planning
