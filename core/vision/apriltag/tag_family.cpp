#include "core/vision/apriltag/tag_family.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>

namespace pulseline::vision {
namespace {

constexpr int kMostWrongBits = 5;  // half the distance between two codes
// Costs count sure cells against a code. Eleven cells lie between two codes; the second best must
// be clearly worse, or glare and dirt decided.
constexpr double kMostCost = 3.0;
constexpr double kLeastLead = 2.0;

/// Sampled cell (row, column) of the tag turned back by quarter turns, mirrored first.
double turned(const TagBits& bits, int row, int column, int quarter_turns, bool mirrored) {
    constexpr int kLast = plant::kTagCells - 1;
    for (int i = 0; i < quarter_turns; ++i) {
        const int r = row;
        row = column;
        column = kLast - r;
    }
    if (mirrored) column = kLast - column;
    return bits[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
}

}  // namespace

const TagFamily& TagFamily::instance() {
    static const TagFamily family;
    return family;
}

TagFamily::TagFamily() {
    const std::unique_ptr<apriltag_family_t, decltype(&tag36h11_destroy)> family(tag36h11_create(),
                                                                                 tag36h11_destroy);
    codes_.assign(family->codes, family->codes + family->ncodes);
    for (std::size_t i = 0; i < kBits; ++i) {
        // The library's first bit is the most significant one.
        row_[kBits - 1 - i] = static_cast<int>(family->bit_y[i]);
        column_[kBits - 1 - i] = static_cast<int>(family->bit_x[i]);
    }
}

bool TagFamily::dark(int id, int row, int column) const {
    constexpr int kLast = plant::kTagCells - 1;
    if (row < 0 || column < 0 || row > kLast || column > kLast) return false;
    if (row == 0 || column == 0 || row == kLast || column == kLast) return true;
    for (std::size_t i = 0; i < kBits; ++i)
        if (row_[i] == row && column_[i] == column)
            return (codes_[static_cast<std::size_t>(id)] >> i & 1U) == 0;
    return false;
}

std::optional<TagCode> TagFamily::decode(const TagBits& bits) const {
    TagCode best;
    double best_cost = std::numeric_limits<double>::max();
    double second_cost = best_cost;
    for (const bool mirrored : {false, true}) {
        for (int turn = 0; turn < 4; ++turn) {
            std::uint64_t light = 0;
            std::array<double, kBits> sure{};
            for (std::size_t i = 0; i < kBits; ++i) {
                const double value = turned(bits, row_[i], column_[i], turn, mirrored);
                light |= static_cast<std::uint64_t>(value < 0) << i;
                sure[i] = std::abs(value);
            }
            for (std::size_t id = 0; id < codes_.size(); ++id) {
                std::uint64_t wrong = codes_[id] ^ light;
                const int count = std::popcount(wrong);
                if (count > 2 * kMostWrongBits) continue;
                double cost = 0;
                for (; wrong != 0; wrong &= wrong - 1)
                    cost += sure[static_cast<std::size_t>(std::countr_zero(wrong))];
                if (cost < best_cost) {
                    second_cost = best_cost;
                    best_cost = cost;
                    best = {static_cast<int>(id), turn, count, mirrored};
                } else {
                    second_cost = std::min(second_cost, cost);
                }
            }
        }
    }
    if (best_cost > kMostCost || best.wrong_bits > kMostWrongBits ||
        second_cost - best_cost < kLeastLead)
        return std::nullopt;
    return best;
}

}  // namespace pulseline::vision
