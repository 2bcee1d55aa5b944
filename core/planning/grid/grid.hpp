#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

/// Cells and the four directions of travel on an occupancy grid.
namespace pulseline::planning {

enum class Direction : std::uint8_t { kEast, kNorth, kWest, kSouth };
constexpr int kDirections = 4;

struct Cell {
    int col = 0;
    int row = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
};

/// By direction; north is towards greater rows.
constexpr std::array<Cell, kDirections> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// The neighbour in direction d.
constexpr Cell next_to(Cell cell, int d) {
    const Cell step = kStep[static_cast<std::size_t>(d)];
    return {cell.col + step.col, cell.row + step.row};
}

/// A box of cells, both ends included; empty when last < first.
struct CellBox {
    Cell first{0, 0};
    Cell last{-1, -1};
    bool empty() const { return last.col < first.col || last.row < first.row; }
};

inline int manhattan(Cell a, Cell b) { return std::abs(a.col - b.col) + std::abs(a.row - b.row); }

}  // namespace pulseline::planning
