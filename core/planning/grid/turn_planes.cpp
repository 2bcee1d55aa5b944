#include "core/planning/grid/turn_planes.hpp"

#include <algorithm>

namespace pulseline::planning {
namespace {

using Word = TurnPlanes::Word;

constexpr int kBlocked = 0;
constexpr int kUsefulUp[] = {1, 3};  // by heading along the line: towards greater, lesser positions
constexpr int kUsefulDown[] = {2, 4};

void put(Word* line, int position, bool value) {
    const Word bit = Word{1} << (position & 63);
    line[position >> 6] = value ? line[position >> 6] | bit : line[position >> 6] & ~bit;
}

}  // namespace

TurnPlanes::TurnPlanes(const BitGrid& blocked) {
    block_all(0, blocked.height() + 2, blocked.width() + 2);
    block_all(1, blocked.width() + 2, blocked.height() + 2);
    for (int row = 0; row < blocked.height(); ++row) {
        for (int col = 0; col < blocked.width(); ++col) {
            if (blocked.test({col, row})) continue;
            put(plane(0, row + 1, kBlocked), col + 1, false);
            put(plane(1, col + 1, kBlocked), row + 1, false);
        }
    }
    sweep(0);
    sweep(1);
}

void TurnPlanes::block_all(int axis, int lines, int positions) {
    Axis& a = axes_[axis];
    a.lines = lines;
    a.stride = (positions + 63) / 64;
    a.words.assign(static_cast<std::size_t>(lines) * kPlanes * static_cast<std::size_t>(a.stride),
                   0);
    for (int line = 0; line < lines; ++line) {
        std::fill_n(plane(axis, line, kBlocked), a.stride, ~Word{0});
    }
}

/// Useful turns of one line from those of the next one to the side that is turned to, 64 at a time:
/// the next cell there is free, and the cell behind it (on the side come from) is blocked or the
/// same holds from it on. Answers whether something changed.
bool TurnPlanes::sweep_line(int axis, int line, bool up, int first_word, int last_word) {
    const int stride = axes_[axis].stride;
    const int next = up ? line + 1 : line - 1;
    const Word* wall = plane(axis, next, kBlocked);
    bool changed = false;
    for (int heading = 0; heading < 2; ++heading) {
        const int index = up ? kUsefulUp[heading] : kUsefulDown[heading];
        const Word* beyond = plane(axis, next, index);
        Word* out = plane(axis, line, index);
        for (int w = first_word; w <= last_word; ++w) {
            // Bit p: cell p - 1 (p + 1 for the backward heading) of the next line is blocked.
            const Word carry = heading == 0 ? (w > 0 ? wall[w - 1] >> 63 : 1)
                                            : (w + 1 < stride ? wall[w + 1] << 63 : Word{1} << 63);
            const Word behind = (heading == 0 ? wall[w] << 1 : wall[w] >> 1) | carry;
            const Word value = ~wall[w] & (behind | beyond[w]);
            changed = changed || out[w] != value;
            out[w] = value;
        }
    }
    return changed;
}

void TurnPlanes::sweep(int axis) {
    const int last_word = axes_[axis].stride - 1;
    for (int line = axes_[axis].lines - 2; line >= 1; --line) {
        sweep_line(axis, line, true, 0, last_word);
    }
    for (int line = 1; line < axes_[axis].lines - 1; ++line) {
        sweep_line(axis, line, false, 0, last_word);
    }
}

void TurnPlanes::set_blocked(Cell cell, bool blocked) {
    for (int axis = 0; axis < 2; ++axis) {
        const int line = (axis == 0 ? cell.row : cell.col) + 1;
        const int position = (axis == 0 ? cell.col : cell.row) + 1;
        put(plane(axis, line, kBlocked), position, blocked);
        // Only rays in the cell's own line across and its two neighbours can see the change.
        const int first_word = (position - 1) >> 6;
        const int last_word = std::min((position + 1) >> 6, axes_[axis].stride - 1);
        for (int l = line - 1; l >= 1 && sweep_line(axis, l, true, first_word, last_word); --l) {
        }
        for (int l = line + 1;
             l < axes_[axis].lines - 1 && sweep_line(axis, l, false, first_word, last_word); ++l) {
        }
    }
}

}  // namespace pulseline::planning
