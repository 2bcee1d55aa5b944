#include "core/planning/grid/turn_jump_search.hpp"

#include <algorithm>

namespace pulseline::planning {
namespace {

constexpr int kSides = 3;

}  // namespace

void TurnJumpSearch::prepare(const GridMap& map) {
    const std::size_t rays = static_cast<std::size_t>(map.width() + map.height() + 4) * 2 * kSides;
    if (rays_.size() < rays) rays_.resize(rays);
}

std::size_t TurnJumpSearch::bytes() const {
    return labels_.bytes() + rays_.capacity() * sizeof(Ray) + queue_.bytes();
}

Cell TurnJumpSearch::cell_of(std::uint32_t state) const {
    const std::uint32_t cell = state / kDirections;
    return {static_cast<int>(cell % stride_), static_cast<int>(cell / stride_)};
}

inline std::uint32_t TurnJumpSearch::steps_left(int col, int row) const {
    const auto& ways = landmarks_->at(row * stride_ + static_cast<std::uint32_t>(col));
    const int floor = std::abs(goal_.col - col) + std::abs(goal_.row - row);
    return static_cast<std::uint32_t>(std::max(floor, Landmarks::least_steps(ways, *goal_ways_)));
}

inline std::uint32_t TurnJumpSearch::turns_left(int col, int row, int heading) const {
    return static_cast<std::uint32_t>(
        FloorBound<int>::least_turns(heading, goal_.col - col, goal_.row - row));
}

void TurnJumpSearch::begin(const GridMap& map, const GridRequest& request, const SmallCost& cost) {
    prepare(map);
    if (++stamp_ == 0) {  // after four billion queries old labels would look new
        std::fill(rays_.begin(), rays_.end(), Ray{});
        stamp_ = 1;
    }
    labels_.clear();
    planes_ = &map.planes();
    landmarks_ = &map.landmarks();
    stride_ = static_cast<std::uint32_t>(map.stride());
    ray_lines_ = static_cast<std::uint32_t>(map.height()) + 2;
    step_ = static_cast<std::uint32_t>(cost.step);
    turn_ = static_cast<std::uint32_t>(cost.turn);
    goal_ = {request.goal.col + 1, request.goal.row + 1};
    goal_ways_ = &landmarks_->at(map.padded(request.goal));
    const auto run = [&](int axis, int line, int position) {
        const auto* blocked = planes_->blocked(axis, line);
        return Run{line, position, previous_set(blocked, position) + 1,
                   next_set(blocked, position) - 1};
    };
    goal_runs_[0] = run(0, goal_.row, goal_.col);
    goal_runs_[1] = run(1, goal_.col, goal_.row);
    best_ = SmallCost::kNoRoute;
    expanded_ = 0;
    popped_ = 0;
    turns_seen_ = 0;
}

/// Rays in all four directions from the start, without a side: any turn may follow.
void TurnJumpSearch::enter(const GridRequest& request) {
    const int col = request.start.col + 1;
    const int row = request.start.row + 1;
    const int longest = static_cast<int>(std::max(stride_, ray_lines_));
    const std::uint32_t least = step_ * steps_left(col, row);
    // A jump adds its steps and a turn, and may raise the bound by as many steps and two turns.
    queue_.reset(least, 2 * step_ * static_cast<std::uint32_t>(longest) + 4 * turn_);
    for (int heading = 0; heading < kDirections; ++heading) {
        const bool turned =
            request.start_heading && static_cast<int>(*request.start_heading) != heading;
        const std::uint32_t cost = turned ? turn_ : 0;
        const std::uint32_t at = state(col, row, heading);
        labels_.reach(at, cost, at, 1u << kNoSide, 0);
        queue_.push(cost + least + turn_ * turns_left(col, row, heading),
                    {cost, static_cast<std::uint16_t>(col), static_cast<std::uint16_t>(row), 0,
                     static_cast<std::uint8_t>(heading), kNoSide});
    }
}

void TurnJumpSearch::arrive(std::uint32_t cost, const Entry& from, Cell corner) {
    if (cost >= best_) return;
    best_ = cost;
    last_state_ = state(from.col, from.row, from.heading);
    last_corner_ = corner;
}

/// Whether a ray already expanded makes the entry needless (see the header).
inline bool TurnJumpSearch::covered(const Entry& entry, int line, int position) const {
    const int axis = entry.heading & 1;
    const bool up = entry.heading < 2;
    const std::size_t slot =
        ((axis == 0 ? 0 : ray_lines_) + static_cast<std::size_t>(line)) * 2 + (up ? 0 : 1);
    const Ray* rays = rays_.data() + slot * kSides;
    for (int side = 0; side < kSides; ++side) {
        const Ray& ray = rays[side];
        if (ray.stamp != stamp_ || position < ray.begin || position > ray.end) continue;
        const int way = up ? position : -position;
        const auto cost = ray.base + static_cast<std::int32_t>(step_) * way;
        const auto own = static_cast<std::int32_t>(entry.cost);
        if (cost < own || (cost == own && (side == entry.side || side == kNoSide))) return true;
    }
    return false;
}

/// A turn at (col, row) out of the ray of `from`; `way` is the least cost of the steps after it.
inline void TurnJumpSearch::generate(const Entry& from, int col, int row, int heading,
                                     std::uint32_t cost, std::uint32_t way) {
    ++turns_seen_;
    const std::uint32_t total = cost + way + turn_ * turns_left(col, row, heading);
    if (total >= best_) return;
    const Side side = from.heading < 2 ? kLesser : kGreater;
    if (!labels_.reach(state(col, row, heading), cost, state(from.col, from.row, from.heading),
                       1u << side, 1u << kNoSide)) {
        return;
    }
    queue_.push(total, {cost, static_cast<std::uint16_t>(col), static_cast<std::uint16_t>(row), 0,
                        static_cast<std::uint8_t>(heading), side});
}

/// Ends of the ray, goal on it or across it, and the first place where a turn may follow.
template <bool kUp>
void TurnJumpSearch::drive_ray(const Entry& entry, int line, int position) {
    const int axis = entry.heading & 1;
    const auto* blocked = planes_->blocked(axis, line);
    const int end =
        kUp ? next_set(blocked, position + 1) - 1 : previous_set(blocked, position - 1) + 1;
    const auto ahead = [&](int p) {
        return kUp ? p > position && p <= end : p < position && p >= end;
    };
    const auto cost_at = [&](int p) {
        return entry.cost + step_ * static_cast<std::uint32_t>(kUp ? p - position : position - p);
    };
    const Run& along = goal_runs_[axis];
    const Run& across = goal_runs_[axis ^ 1];
    if (along.line == line && ahead(along.goal)) {
        arrive(cost_at(along.goal), entry, goal_);
    } else if (ahead(across.line) && line >= across.first && line <= across.last) {
        const Cell corner = axis == 0 ? Cell{across.line, line} : Cell{line, across.line};
        arrive(cost_at(across.line) + turn_ +
                   step_ * static_cast<std::uint32_t>(std::abs(line - across.goal)),
               entry, corner);
    }
    const std::size_t slot =
        ((axis == 0 ? 0 : ray_lines_) + static_cast<std::size_t>(line)) * 2 + (kUp ? 0 : 1);
    const auto base = static_cast<std::int32_t>(entry.cost) -
                      static_cast<std::int32_t>(step_) * (kUp ? position : -position);
    rays_[slot * kSides + entry.side] = {stamp_, base,
                                         static_cast<std::uint16_t>(kUp ? position : end),
                                         static_cast<std::uint16_t>(kUp ? end : position)};
    int first = kUp ? position + 1 : position - 1;
    if (entry.side != kNoSide) {
        const auto* beside = planes_->blocked(axis, entry.side == kLesser ? line - 1 : line + 1);
        first = kUp ? next_set(beside, first) : previous_set(beside, first);
    }
    if (kUp ? first > end : first < end) return;
    turn_off<kUp>(entry, line, position, first, end);
}

/// Candidates from `first` on, up to where the ray's bound exceeds what is expanded now: it never
/// falls along a ray, so the rest waits in the queue, and behind the best route for good.
template <bool kUp>
void TurnJumpSearch::turn_off(const Entry& entry, int line, int position, int first, int end) {
    const int axis = entry.heading & 1;
    const auto* up = planes_->useful(entry.heading, true, line);
    const auto* down = planes_->useful(entry.heading, false, line);
    const int turned = axis ^ 1;
    using Word = TurnPlanes::Word;
    const int last_word = end >> 6;
    for (int w = first >> 6;; w += kUp ? 1 : -1) {
        Word mask = ~Word{0};
        if (w == first >> 6) {
            mask &= kUp ? ~Word{0} << (first & 63) : ~Word{0} >> (63 - (first & 63));
        }
        if (w == last_word) {
            mask &= kUp ? ~Word{0} >> (63 - (end & 63)) : ~Word{0} << (end & 63);
        }
        const Word ups = up[w];
        const Word downs = down[w];
        for (Word bits = (ups | downs) & mask; bits != 0;) {
            const int bit = kUp ? __builtin_ctzll(bits) : 63 - __builtin_clzll(bits);
            bits ^= Word{1} << bit;
            const int p = (w << 6) + bit;
            const int col = axis == 0 ? p : line;
            const int row = axis == 0 ? line : p;
            const std::uint32_t cost =
                entry.cost + step_ * static_cast<std::uint32_t>(kUp ? p - position : position - p);
            const std::uint32_t way = step_ * steps_left(col, row);
            const std::uint32_t onward = cost + way + turn_ * turns_left(col, row, entry.heading);
            if (onward > expanding_) {
                if (onward < best_) {
                    Entry rest = entry;
                    rest.resume = static_cast<std::uint16_t>(p);
                    queue_.push(onward, rest);
                }
                return;
            }
            if ((ups >> bit & 1) != 0) generate(entry, col, row, turned, cost + turn_, way);
            if ((downs >> bit & 1) != 0) generate(entry, col, row, turned + 2, cost + turn_, way);
        }
        if (w == last_word) return;
    }
}

template <bool kUp>
void TurnJumpSearch::expand_ray(const Entry& entry, int line, int position) {
    if (entry.resume == 0) return drive_ray<kUp>(entry, line, position);
    const auto* blocked = planes_->blocked(entry.heading & 1, line);
    const int from = entry.resume;
    const int end = kUp ? next_set(blocked, from) - 1 : previous_set(blocked, from) + 1;
    turn_off<kUp>(entry, line, position, from, end);
}

void TurnJumpSearch::expand(const Entry& entry) {
    const bool along_row = (entry.heading & 1) == 0;
    const int line = along_row ? entry.row : entry.col;
    const int position = along_row ? entry.col : entry.row;
    if (entry.resume == 0) {
        if (entry.side != kNoSide && covered(entry, line, position)) return;
        ++expanded_;
    }
    if (entry.heading < 2) {
        expand_ray<true>(entry, line, position);
    } else {
        expand_ray<false>(entry, line, position);
    }
}

void TurnJumpSearch::trace(const GridRequest& request, GridRoute& route) const {
    route.corners.clear();
    route.corners.push_back(request.goal);
    const auto put = [&](Cell padded) {
        route.corners.push_back({padded.col - 1, padded.row - 1});
    };
    if (!(last_corner_ == goal_)) put(last_corner_);
    std::uint32_t at = last_state_;
    while (true) {
        put(cell_of(at));
        const std::uint32_t parent = labels_.known(at).parent();
        if (parent == at) break;
        at = parent;
    }
    std::reverse(route.corners.begin(), route.corners.end());
    route.length = 0;
    for (std::size_t i = 1; i < route.corners.size(); ++i) {
        route.length += manhattan(route.corners[i - 1], route.corners[i]);
    }
    const bool turned = request.start_heading && static_cast<int>(*request.start_heading) !=
                                                     static_cast<int>(at % kDirections);
    route.turns = static_cast<int>(route.corners.size()) - 2 + (turned ? 1 : 0);
}

SearchEnd TurnJumpSearch::run(const GridMap& map, const GridRequest& request, GridRoute& route) {
    const auto cost = SmallCost::of(request.cost, map);
    if (map.weighted() || !cost || cost->turn < 0 ||
        map.padded_cells() * kDirections > LabelTable::kMostStates) {
        return SearchEnd::kUnfit;
    }
    if (!map.is_plain(request.start) || !map.is_plain(request.goal)) return SearchEnd::kNoRoute;
    if (map.landmarks().separate(map.padded(request.start), map.padded(request.goal))) {
        return SearchEnd::kNoRoute;
    }
    begin(map, request, *cost);
    enter(request);
    std::int64_t look = kCancelEvery;
    while (true) {
        const std::uint32_t least = queue_.least();
        if (least >= best_) break;  // an empty queue's is the greatest of all
        if (least >= SmallCost::kMost / 2) return SearchEnd::kUnfit;
        expanding_ = least + queue_.bucket_width() - 1;
        const Entry entry = queue_.pop();
        ++popped_;
        const auto& label = labels_.known(state(entry.col, entry.row, entry.heading));
        if (label.cost != entry.cost) continue;  // reached at less since
        expand(entry);
        if (popped_ < look) continue;
        look = popped_ + kCancelEvery;
        const bool cancelled = request.cancel && request.cancel->load(std::memory_order_relaxed);
        if (cancelled || work() > most_work_) return SearchEnd::kCancelled;
    }
    route.expanded = expanded_;
    if (best_ == SmallCost::kNoRoute) return SearchEnd::kNoRoute;
    route.cost = std::int64_t{best_} * cost->unit;
    trace(request, route);
    return SearchEnd::kFound;
}

}  // namespace pulseline::planning
