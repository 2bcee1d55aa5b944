#include "core/planning/grid/bucket_search.hpp"

#include <algorithm>

#include "core/planning/grid/grid_trace.hpp"

namespace pulseline::planning {
template <class Label>
void BucketSearch<Label>::prepare(const GridMap& map) {
    const std::size_t states = map.padded_cells() * kDirections;
    if (labels_.size() < states) labels_.resize(states, static_cast<Label>(~Label{0}));
}

template <class Label>
std::size_t BucketSearch<Label>::bytes() const {
    return labels_.capacity() * sizeof(Label) + queue_.bytes();
}

template <class Label>
void BucketSearch<Label>::begin(const GridMap& map, const GridRequest& request,
                                const SmallCost& cost) {
    prepare(map);
    constexpr std::uint64_t kStamps = std::uint64_t{1} << kStampBits;
    if (++stamp_ == kStamps) {
        std::fill(labels_.begin(), labels_.end(), ~Label{0});
        stamp_ = 1;
    }
    high_ = static_cast<Label>(kStamps - 1 - stamp_) << (kCostBits + kByBits);
    step_ = cost.step;
    turn_ = cost.turn;
    goal_ = request.goal;
    bound_.emplace(goal_, step_, turn_);
    landmarks_ = &map.landmarks();
    goal_ways_ = &landmarks_->at(map.padded(goal_));
    const int least =
        std::max(manhattan(request.start, goal_), least_steps(map.padded(request.start)));
    const auto dearest =
        static_cast<std::uint32_t>(2 * step_ * map.greatest_weight() + 4 * std::max(turn_, 0));
    queue_.reset(static_cast<std::uint32_t>(bound_->per_step() * least), dearest);
    most_ = (1u << kCostBits) - 1 - std::min((1u << kCostBits) - 1, dearest);
    best_ = SmallCost::kNoRoute;
    expanded_ = 0;
}

template <class Label>
inline void BucketSearch<Label>::reach(const GridMap& map, Cell cell, std::uint32_t state,
                                       std::uint32_t cost, Label by, int heading) {
    const Label label = high_ | static_cast<Label>(cost) << kByBits;
    Label& known = labels_.data()[state];
    if (label >= (known & ~kBy)) return;
    // Who is there with another heading for the price of a turn less goes on as cheaply.
    if (turn_ > 0 && cost >= static_cast<std::uint32_t>(turn_) &&
        (map.moves(state / kDirections) & GridMap::kMayTurn) != 0) {
        const Label most = label - (static_cast<Label>(turn_) << kByBits);
        const Label* const headings = labels_.data() + state / kDirections * kDirections;
        if (std::any_of(headings, headings + kDirections,
                        [&](Label one) { return (one & ~kBy) <= most; })) {
            return;
        }
    }
    known = label | by;
    if (cell == goal_) {
        if (cost >= best_) return;
        best_ = cost;
        best_state_ = state;
        return;
    }
    const std::int32_t left = (*bound_)(cell, heading, least_steps(state / kDirections));
    queue_.push(
        cost + static_cast<std::uint32_t>(left),
        {state, cost, static_cast<std::uint16_t>(cell.col), static_cast<std::uint16_t>(cell.row)});
}

template <class Label>
void BucketSearch<Label>::enter(const GridMap& map, const GridRequest& request) {
    const std::size_t start = map.padded(request.start);
    for (int d = 0; d < kDirections; ++d) {
        const Cell step = kStep[static_cast<std::size_t>(d)];
        const Cell next{request.start.col + step.col, request.start.row + step.row};
        if (request.start_heading) {
            if (static_cast<int>(*request.start_heading) != d ||
                map.layers().is_blocked(*request.start_heading, request.start)) {
                continue;
            }
            reach(map, request.start, static_cast<std::uint32_t>(start * kDirections) + d, 0,
                  kStart, d);
        } else if ((map.moves(start) >> d & 1) != 0) {
            reach(map, next, static_cast<std::uint32_t>(map.padded(next) * kDirections) + d,
                  static_cast<std::uint32_t>(step_ * map.weight(next)), kFirstStep, d);
        }
    }
}

template <class Label>
inline void BucketSearch<Label>::expand(const GridMap& map, const Entry& entry) {
    const int heading = static_cast<int>(entry.state % kDirections);
    const std::uint32_t cell = entry.state / kDirections;
    unsigned moves = map.moves(cell);
    if ((moves & GridMap::kMayTurn) == 0) moves &= 1u << heading;
    // Where every cell may be turned in, back along the same way is never part of a best route.
    if (map.uniform() && turn_ >= 0 && (labels_.data()[entry.state] & kBy) != kStart) {
        moves &= ~(1u << (heading ^ 2));
    }
    const auto stride = static_cast<std::int32_t>(map.stride());
    const std::int32_t offset[] = {1, stride, -1, -stride};
    for (int d = 0; d < kDirections; ++d) {
        if ((moves >> d & 1) == 0) continue;
        const Cell step = kStep[static_cast<std::size_t>(d)];
        const Cell next{entry.col + step.col, entry.row + step.row};
        const std::int32_t way = map.weighted() ? step_ * map.weight(next) : step_;
        const std::uint32_t cost =
            entry.cost + static_cast<std::uint32_t>(way + (d == heading ? 0 : turn_));
        const auto to = static_cast<std::uint32_t>(static_cast<std::int32_t>(cell) + offset[d]);
        reach(map, next, to * kDirections + static_cast<std::uint32_t>(d), cost,
              static_cast<Label>(heading), d);
    }
}

template <class Label>
void BucketSearch<Label>::trace(const GridMap& map, const GridRequest& request,
                                GridRoute& route) const {
    RouteTrace trace(request, route);
    std::uint32_t state = best_state_;
    const auto stride = static_cast<std::int32_t>(map.stride());
    const std::int32_t offset[] = {1, stride, -1, -stride};
    while (true) {
        const Label by = labels_[state] & kBy;
        if (by == kStart) break;
        const auto heading = state % kDirections;
        trace.step_back(static_cast<int>(heading));
        if (by == kFirstStep) break;
        const auto cell = static_cast<std::int32_t>(state / kDirections) - offset[heading];
        state = static_cast<std::uint32_t>(cell) * kDirections + static_cast<std::uint32_t>(by);
    }
    trace.finish();
}

template <class Label>
SearchEnd BucketSearch<Label>::run(const GridMap& map, const GridRequest& request, GridRoute& route,
                                   std::optional<std::int64_t> below) {
    const auto cost = SmallCost::of(request.cost, map);
    if (!cost) return SearchEnd::kUnfit;
    if (map.landmarks().separate(map.padded(request.start), map.padded(request.goal))) {
        return SearchEnd::kNoRoute;
    }
    begin(map, request, *cost);
    if (below) {
        const std::int64_t most = (*below + cost->unit - 1) / cost->unit;
        best_ = static_cast<std::uint32_t>(std::min<std::int64_t>(best_, most));
    }
    const std::uint32_t to_beat = best_;
    enter(map, request);
    std::int64_t look = kCancelEvery;
    while (true) {
        const std::uint32_t least = queue_.least();
        if (least >= best_) break;  // an empty queue's is the greatest of all
        if (least >= most_) return SearchEnd::kUnfit;
        const Entry entry = queue_.pop();
        if (labels_.data()[entry.state] >> kByBits != (high_ >> kByBits | entry.cost)) continue;
        ++expanded_;
        expand(map, entry);
        if (expanded_ < look) continue;
        look = expanded_ + kCancelEvery;
        const bool cancelled = request.cancel && request.cancel->load(std::memory_order_relaxed);
        if (cancelled || expanded_ > most_work_) return SearchEnd::kCancelled;
    }
    if (best_ == to_beat) return SearchEnd::kNoRoute;
    route.expanded = expanded_;
    route.cost = std::int64_t{best_} * cost->unit;
    trace(map, request, route);
    return SearchEnd::kFound;
}

template class BucketSearch<std::uint32_t>;
template class BucketSearch<std::uint64_t>;

}  // namespace pulseline::planning
