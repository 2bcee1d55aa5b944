#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/planning/grid/grid.hpp"

namespace pulseline::planning {

/// One bit per cell, rows in 64-cell words; bits behind the last column are 0.
class BitGrid {
public:
    using Word = std::uint64_t;
    static constexpr int kWordBits = 64;

    BitGrid() = default;
    BitGrid(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return words_.empty(); }
    bool inside(Cell cell) const {
        return cell.col >= 0 && cell.row >= 0 && cell.col < width_ && cell.row < height_;
    }

    // REQUIRES: inside(cell).
    bool test(Cell cell) const { return (words_[index(cell)] >> (cell.col % kWordBits) & 1) != 0; }
    void set(Cell cell, bool value);

    std::span<Word> row(int index);
    std::span<const Word> row(int index) const;

    // Columns first to last of a row; what lies outside the grid is left out.
    void set_range(int row, int first, int last);
    bool any(int row, int first, int last) const;

    std::size_t count() const;
    std::size_t bytes() const { return words_.size() * sizeof(Word); }
    friend bool operator==(const BitGrid&, const BitGrid&) = default;

private:
    std::size_t index(Cell cell) const {
        return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(stride_) +
               static_cast<std::size_t>(cell.col / kWordBits);
    }

    int width_ = 0;
    int height_ = 0;
    int stride_ = 0;  // words of a row
    std::vector<Word> words_;
};

}  // namespace pulseline::planning
