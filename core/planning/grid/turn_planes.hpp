#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/planning/grid/bit_grid.hpp"

namespace pulseline::planning {

/// Bit planes of a uniform grid for the turn-jump search, along rows (axis 0) and columns (axis 1).
///
/// A line is a row or column with one blocked cell put on at either end, and one blocked line lies
/// on either side of the grid, so that scans need no bounds: position p of a line is cell p - 1.
/// Per axis five planes: blocked cells, and for each heading along the line and each side to turn
/// to, the *useful* turns: the free ray after the turn passes a blocked cell on the side that the
/// vehicle came from (see turn_jump_search.hpp). 10 bits a cell in all.
class TurnPlanes {
public:
    using Word = BitGrid::Word;

    explicit TurnPlanes(const BitGrid& blocked);

    const Word* blocked(int axis, int line) const { return plane(axis, line, 0); }
    /// Turns from heading `from` to the side of greater (`up`) or lesser perpendicular lines.
    const Word* useful(int from, bool up, int line) const {
        return plane(from & 1, line, 1 + (from >= 2 ? 2 : 0) + (up ? 0 : 1));
    }

    bool is_blocked(Cell cell) const {
        const int at = cell.col + 1;
        return (blocked(0, cell.row + 1)[at / BitGrid::kWordBits] >> (at % BitGrid::kWordBits) &
                1) != 0;
    }
    /// Follows an edit of the map: O(affected lines) words instead of a rebuild.
    void set_blocked(Cell cell, bool blocked);

    std::size_t bytes() const {
        return (axes_[0].words.size() + axes_[1].words.size()) * sizeof(Word);
    }
    friend bool operator==(const TurnPlanes&, const TurnPlanes&) = default;

private:
    static constexpr int kPlanes = 5;

    struct Axis {
        int lines = 0;            // with the two blocked ones
        int stride = 0;           // words of a line in one plane
        std::vector<Word> words;  // [line][plane][word]
        friend bool operator==(const Axis&, const Axis&) = default;
    };

    const Word* plane(int axis, int line, int index) const {
        const Axis& a = axes_[axis];
        return a.words.data() +
               (static_cast<std::size_t>(line) * kPlanes + static_cast<std::size_t>(index)) *
                   static_cast<std::size_t>(a.stride);
    }
    Word* plane(int axis, int line, int index) {
        return const_cast<Word*>(std::as_const(*this).plane(axis, line, index));
    }
    void block_all(int axis, int lines, int positions);
    bool sweep_line(int axis, int line, bool up, int first_word, int last_word);
    void sweep(int axis);

    Axis axes_[2];
};

// --- scanning, 64 cells a word ------------------------------------------------------------------

/// First set bit at or after `from`. REQUIRES: there is one.
inline int next_set(const BitGrid::Word* words, int from) {
    int w = from >> 6;
    BitGrid::Word bits = words[w] & (~BitGrid::Word{0} << (from & 63));
    while (bits == 0) bits = words[++w];
    return (w << 6) + __builtin_ctzll(bits);
}

/// Last set bit at or before `from`. REQUIRES: there is one.
inline int previous_set(const BitGrid::Word* words, int from) {
    int w = from >> 6;
    BitGrid::Word bits = words[w] & (~BitGrid::Word{0} >> (63 - (from & 63)));
    while (bits == 0) bits = words[--w];
    return (w << 6) + 63 - __builtin_clzll(bits);
}

/// Calls visit(position) for the set bits of [first, last], upwards.
template <class Visit>
inline void for_set_upwards(const BitGrid::Word* words, int first, int last, Visit visit) {
    for (int w = first >> 6; w <= last >> 6; ++w) {
        BitGrid::Word bits = words[w];
        if (w == first >> 6) bits &= ~BitGrid::Word{0} << (first & 63);
        if (w == last >> 6) bits &= ~BitGrid::Word{0} >> (63 - (last & 63));
        for (; bits != 0; bits &= bits - 1) visit((w << 6) + __builtin_ctzll(bits));
    }
}

/// The same downwards from `last` to `first`.
template <class Visit>
inline void for_set_downwards(const BitGrid::Word* words, int first, int last, Visit visit) {
    for (int w = last >> 6; w >= first >> 6; --w) {
        BitGrid::Word bits = words[w];
        if (w == first >> 6) bits &= ~BitGrid::Word{0} << (first & 63);
        if (w == last >> 6) bits &= ~BitGrid::Word{0} >> (63 - (last & 63));
        while (bits != 0) {
            const int bit = 63 - __builtin_clzll(bits);
            visit((w << 6) + bit);
            bits ^= BitGrid::Word{1} << bit;
        }
    }
}

}  // namespace pulseline::planning
