#pragma once

#include <cstdint>
#include <vector>

namespace pulseline::planning {

/// Labels of the few states that a query touches, by state: open addressing, emptied by a new
/// stamp. It starts small enough for the first cache and grows with the query; memory once taken
/// is kept for later ones.
class LabelTable {
public:
    static constexpr std::uint32_t kUnreached = 0xFFFFFFFF;
    static constexpr int kStateBits = 29;  // the other three of a parent are its sides
    static constexpr std::uint32_t kMostStates = 1u << kStateBits;

    struct Label {
        std::uint32_t stamp = 0;
        std::uint32_t state = 0;
        std::uint32_t cost = kUnreached;
        std::uint32_t parent_and_sides = 0;

        /// State it was reached from.
        std::uint32_t parent() const { return parent_and_sides & (kMostStates - 1); }
    };

    /// Forgets all labels.
    void clear() {
        if (labels_.size() < kFirst) labels_.resize(kFirst);
        if (++stamp_ >= kLastStamp) {  // after billions of queries old labels would look new
            labels_.assign(labels_.size(), Label{});
            stamp_ = 1;
        }
        used_ = 0;
        resize(kFirst);
    }

    /// Reaches a state at a cost from another one, come from some sides (bits; those in `any` stand
    /// for all). False when that is no news: reached at less, or at the same cost from that side.
    bool reach(std::uint32_t state, std::uint32_t cost, std::uint32_t from, std::uint32_t sides,
               std::uint32_t any) {
        Label& label = find(state);
        if (label.stamp != stamp_) {
            label = {stamp_, state, cost, from | sides << kStateBits};
            if (2 * ++used_ > mask_) grow();
            return true;
        }
        if (cost > label.cost) return false;
        if (cost < label.cost) {
            label.cost = cost;
            label.parent_and_sides = from | sides << kStateBits;
            return true;
        }
        if ((label.parent_and_sides >> kStateBits & (sides | any)) != 0) return false;
        label.parent_and_sides |= sides << kStateBits;
        return true;
    }

    /// REQUIRES: the state was reached since clear().
    const Label& known(std::uint32_t state) const { return labels_.data()[place(state)]; }

    std::size_t bytes() const { return (labels_.capacity() + moved_.capacity()) * sizeof(Label); }

private:
    static constexpr std::size_t kFirst = 1u << 11;
    static constexpr std::uint32_t kLastStamp = 0xFFFFFF00;  // room for the growths of one query

    void resize(std::size_t size) {
        mask_ = static_cast<std::uint32_t>(size - 1);
        shift_ = 34 - __builtin_ctzll(size);
    }

    /// Where the label of a state is, or would be.
    std::uint32_t place(std::uint32_t state) const {
        const Label* labels = labels_.data();
        // The four states of a cell lie side by side: who looks at one soon looks at another.
        std::uint32_t i = ((state >> 2) * 0x9E3779B1u >> shift_) << 2 | (state & 3);
        while (labels[i].stamp == stamp_ && labels[i].state != state) i = (i + 1) & mask_;
        return i;
    }
    Label& find(std::uint32_t state) { return labels_.data()[place(state)]; }

    void grow() {
        moved_.clear();
        for (std::size_t i = 0; i <= mask_; ++i) {
            if (labels_[i].stamp == stamp_) moved_.push_back(labels_[i]);
        }
        const std::size_t size = 2 * (std::size_t{mask_} + 1);
        if (labels_.size() < size) labels_.resize(size);
        ++stamp_;
        resize(size);
        for (const Label& label : moved_) {
            find(label.state) = {stamp_, label.state, label.cost, label.parent_and_sides};
        }
    }

    std::vector<Label> labels_;
    std::vector<Label> moved_;
    std::uint32_t stamp_ = 0;
    std::uint32_t mask_ = 0;
    int shift_ = 32;
    std::uint32_t used_ = 0;
};

}  // namespace pulseline::planning
