#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "core/planning/roads/road_view.hpp"
#include "core/planning/search/bucket_queue.hpp"

namespace pulseline::planning {

/// Exact cost from the end of every arc to one node, and the arc to take next: Dijkstra backwards
/// over directed arcs, so that every change of direction is seen. What a query from anywhere to
/// that node needs is then a walk along `next`, and a dispatch cost is one read.
class CostTable {
public:
    static constexpr int kArrived = -1;

    struct Open {
        std::int32_t arc;
        RoadCost cost;
    };
    /// Memory that builds and repairs share; one per thread.
    struct Scratch {
        BucketQueue<Open> queue;
        std::vector<std::int32_t> affected;
        std::vector<char> is_affected;
        const std::atomic<bool>* cancel = nullptr;  // set by anyone, looked at every 1,000 arcs
    };

    CostTable(const RoadView& view, int goal, Scratch& scratch);

    /// Follows changes of the costs of `arcs`, up or down. Only what lies behind a changed arc is
    /// worked out anew (Ramalingam and Reps, "An Incremental Algorithm for a Generalization of the
    /// Shortest-Path Problem", 1996).
    void repair(const RoadView& view, std::span<const int> arcs, Scratch& scratch);

    int goal() const { return goal_; }
    /// False when the last build or repair was cancelled: it knows nothing to rely on.
    bool complete() const { return complete_; }
    /// From the end of the arc; kNoWay when no way leads there.
    RoadCost left(int arc) const { return left_[static_cast<std::size_t>(arc)]; }
    /// The arc to drive after this one; kArrived at the goal.
    int next(int arc) const { return next_[static_cast<std::size_t>(arc)]; }
    std::size_t bytes() const {
        return left_.size() * sizeof(RoadCost) + next_.size() * sizeof(std::int32_t);
    }

private:
    void reach(int arc, RoadCost cost, int next, Scratch& scratch);
    void settle(const RoadView& view, Scratch& scratch);

    int goal_;
    bool complete_ = true;
    std::vector<RoadCost> left_;
    std::vector<std::int32_t> next_;
};

}  // namespace pulseline::planning
