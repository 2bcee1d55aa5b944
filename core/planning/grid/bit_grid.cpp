#include "core/planning/grid/bit_grid.hpp"

#include <algorithm>
#include <bit>

namespace pulseline::planning {
namespace {

/// Calls with (word index, mask) for the columns of a clipped range until `visit` answers true.
template <class Visit>
bool any_word(int width, int first, int last, Visit visit) {
    first = std::max(first, 0);
    last = std::min(last, width - 1);
    if (first > last) return false;
    constexpr int kBits = BitGrid::kWordBits;
    constexpr BitGrid::Word kAll = ~BitGrid::Word{0};
    for (int w = first / kBits; w <= last / kBits; ++w) {
        BitGrid::Word mask = kAll;
        if (w == first / kBits) mask &= kAll << (first % kBits);
        if (w == last / kBits) mask &= kAll >> (kBits - 1 - last % kBits);
        if (visit(static_cast<std::size_t>(w), mask)) return true;
    }
    return false;
}

}  // namespace

BitGrid::BitGrid(int width, int height)
    : width_(width),
      height_(height),
      stride_((width + kWordBits - 1) / kWordBits),
      words_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height), 0) {}

void BitGrid::set(Cell cell, bool value) {
    const Word bit = Word{1} << (cell.col % kWordBits);
    Word& target = words_[index(cell)];
    target = value ? target | bit : target & ~bit;
}

std::span<BitGrid::Word> BitGrid::row(int index) {
    const auto stride = static_cast<std::size_t>(stride_);
    return std::span(words_).subspan(static_cast<std::size_t>(index) * stride, stride);
}

std::span<const BitGrid::Word> BitGrid::row(int index) const {
    const auto stride = static_cast<std::size_t>(stride_);
    return std::span(words_).subspan(static_cast<std::size_t>(index) * stride, stride);
}

void BitGrid::set_range(int index, int first, int last) {
    if (index < 0 || index >= height_) return;
    const auto words = row(index);
    any_word(width_, first, last, [&](std::size_t w, Word mask) {
        words[w] |= mask;
        return false;
    });
}

bool BitGrid::any(int index, int first, int last) const {
    if (index < 0 || index >= height_) return false;
    const auto words = row(index);
    return any_word(width_, first, last,
                    [&](std::size_t w, Word mask) { return (words[w] & mask) != 0; });
}

std::size_t BitGrid::count() const {
    std::size_t sum = 0;
    for (const Word w : words_) sum += static_cast<std::size_t>(std::popcount(w));
    return sum;
}

}  // namespace pulseline::planning
