#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace pulseline::planning {

/// Monotone priority queue over integer keys: a ring of buckets, each a stack, and a bitmap of
/// those in use (Dial, "Algorithm 360", CACM 1969; the last in goes first out, which follows a path
/// instead of a front). Buckets may be wider than one key: then items leave a bucket in any order,
/// and the search must allow for a better way to a place it has already expanded.
///
/// Nothing is allocated once pool and ring have grown to a query's size.
template <class Item>
class BucketQueue {
public:
    using Key = std::uint32_t;
    static constexpr Key kNone = std::numeric_limits<Key>::max();

    /// Empties the queue for keys from `least` on, no push being more than `span` above the least
    /// key in the queue.
    void reset(Key least, Key span) {
        clear();
        shift_ = 0;
        while ((span >> shift_) + 2 > kMostBuckets) ++shift_;
        const auto buckets = std::bit_ceil(std::max<Key>((span >> shift_) + 2, 64));
        if (heads_.size() < buckets) {
            heads_.resize(buckets, kEnd);
            used_.resize(buckets / 64, 0);
        }
        mask_ = buckets - 1;
        base_ = least;
        current_ = 0;
    }

    void push(Key key, const Item& item) {
        // Rounding down of a key below the current bucket can only come from an inconsistent bound.
        const Key bucket = std::max((key - base_) >> shift_, current_);
        const Key slot = bucket & mask_;
        std::uint32_t& head = heads_.data()[slot];
        if (spare_ == kEnd) {
            spare_ = static_cast<std::uint32_t>(pool_.size());
            pool_.push_back({item, kEnd});
        }
        Entry& entry = pool_.data()[spare_];
        const std::uint32_t place = spare_;
        spare_ = entry.next;
        entry = {item, head};
        head = place;
        used_.data()[slot >> 6] |= std::uint64_t{1} << (slot & 63);
        ++size_;
    }

    Key bucket_width() const { return Key{1} << shift_; }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }

    /// Lower bound of the keys in the queue; moves on to the first bucket in use. kNone when empty.
    Key least() {
        if (size_ == 0) return kNone;
        Key slot = current_ & mask_;
        Key word = slot >> 6;
        const std::uint64_t* used = used_.data();
        std::uint64_t bits = used[word] & (~std::uint64_t{0} << (slot & 63));
        while (bits == 0) {
            word = (word + 1) & (mask_ >> 6);
            bits = used[word];
        }
        const Key found = (word << 6) + static_cast<Key>(__builtin_ctzll(bits));
        current_ += (found - slot) & mask_;
        return base_ + (current_ << shift_);
    }

    /// REQUIRES: least() was called since the last push and was not kNone.
    Item pop() {
        const Key slot = current_ & mask_;
        std::uint32_t& head = heads_.data()[slot];
        const std::uint32_t place = head;
        Entry& entry = pool_.data()[place];
        const Item item = entry.item;
        head = entry.next;
        if (head == kEnd) used_.data()[slot >> 6] &= ~(std::uint64_t{1} << (slot & 63));
        entry.next = spare_;
        spare_ = place;
        --size_;
        return item;
    }

    std::size_t bytes() const {
        return pool_.capacity() * sizeof(Entry) + heads_.capacity() * sizeof(std::uint32_t) +
               used_.capacity() * sizeof(std::uint64_t);
    }

private:
    static constexpr std::uint32_t kEnd = 0xFFFFFFFF;
    static constexpr Key kMostBuckets = 4096;  // 16 KB of heads: stays in the first cache

    struct Entry {
        Item item;
        std::uint32_t next;
    };

    void clear() {
        for (std::size_t w = 0; size_ != 0 && w < used_.size(); ++w) {
            for (; used_[w] != 0; used_[w] &= used_[w] - 1) {
                heads_[w * 64 + static_cast<std::size_t>(__builtin_ctzll(used_[w]))] = kEnd;
            }
        }
        pool_.clear();
        spare_ = kEnd;
        size_ = 0;
    }

    std::vector<Entry> pool_;
    std::vector<std::uint32_t> heads_;
    std::vector<std::uint64_t> used_;
    std::uint32_t spare_ = kEnd;
    std::size_t size_ = 0;
    Key mask_ = 0;
    Key base_ = 0;
    Key current_ = 0;
    int shift_ = 0;
};

}  // namespace pulseline::planning
