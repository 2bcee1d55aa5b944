#include <algorithm>
#include <limits>

#include "core/traffic/window_search.hpp"

/// When floor is free for the vehicle that a way is searched for.
namespace pulseline::traffic {
namespace {

constexpr std::ptrdiff_t kRecent = 12;  // stays looked back at; more costs more than it saves

}  // namespace

/// When others stay on the tile, from the start on and in the order of its queue. Floors overlap a
/// lot, and each stay's times have to be looked up in its vehicle's plan: once a search.
const WindowSearch::Range& WindowSearch::busy_windows(TileIndex tile) {
    if (tile >= tile_ranges_.size()) tile_ranges_.resize(tile + std::size_t{1});
    Range& range = tile_ranges_[tile];
    if (range.stamp == stamp_) return range;
    range = {static_cast<std::uint32_t>(busy_.size()), 0, stamp_};
    for (const Use& use : joint_->queue(tile)) {
        if (use.vehicle == task_->vehicle) continue;
        const double end_s = joint_->end_of(use);
        if (end_s <= task_->start_s) continue;  // over before anything begins
        if (task_->only_lasting && end_s < task_->now_s + kBlocked_s / 2) continue;
        busy_.push_back({joint_->start_of(use), end_s});
    }
    range.count = static_cast<std::uint32_t>(busy_.size()) - range.begin;
    return range;
}

/// Intervals from the start on in which no other vehicle stays on any of the tiles.
WindowSearch::Range WindowSearch::free_windows(const TileIndexes& tiles) {
    const auto same = [](const Window& a, const Window& b) {
        return a.from_s == b.from_s && a.to_s == b.to_s;
    };
    blocked_.clear();
    Range last;
    for (const TileIndex tile : tiles) {
        // Neighbouring tiles mostly have the same stays: a long body covers hundreds of tiles, but
        // only a few queues differ.
        const Range range = busy_windows(tile);
        const auto begin = busy_.begin() + range.begin;
        if (range.count == last.count &&
            std::equal(begin, begin + range.count, busy_.begin() + last.begin, same)) {
            continue;
        }
        last = range;
        for (auto busy = begin; busy != begin + range.count; ++busy) {
            const auto recent =
                blocked_.size() > kRecent ? blocked_.end() - kRecent : blocked_.begin();
            const bool seen = std::any_of(recent, blocked_.end(),
                                          [&](const Window& other) { return same(*busy, other); });
            if (!seen) blocked_.push_back(*busy);
        }
    }
    const auto sooner = [](const Window& a, const Window& b) {
        return a.from_s != b.from_s ? a.from_s < b.from_s : a.to_s < b.to_s;
    };
    // One queue's stays are in order already.
    if (!std::is_sorted(blocked_.begin(), blocked_.end(), sooner)) {
        std::sort(blocked_.begin(), blocked_.end(), sooner);
    }
    Range range{static_cast<std::uint32_t>(pool_.size()), 0, stamp_};
    double free_from_s = task_->start_s;
    for (const Window& busy : blocked_) {
        if (busy.from_s > free_from_s) pool_.push_back({free_from_s, busy.from_s});
        free_from_s = std::max(free_from_s, busy.to_s);
    }
    if (free_from_s < task_->now_s + kBlocked_s / 2) pool_.push_back({free_from_s, kEver_s});
    range.count = static_cast<std::uint32_t>(pool_.size()) - range.begin;
    return range;
}

const WindowSearch::Range& WindowSearch::place_windows(PlaceIndex place) {
    Range& range = place_ranges_[place];
    if (range.stamp != stamp_) range = free_windows(stand_of(place));
    return range;
}

const WindowSearch::Range& WindowSearch::arc_windows(std::uint32_t arc) {
    const auto& a = task_->graph->arcs[arc];
    Range& range = floor_ranges_[a.floor];
    if (range.stamp != stamp_) range = free_windows(a.shape->swept);
    return range;
}

}  // namespace pulseline::traffic
