#include "core/planning/roads/cost_table.hpp"

#include <algorithm>

namespace pulseline::planning {
namespace {

constexpr std::uint32_t kLookEvery = 1024;  // arcs, at the flag to cancel

}  // namespace

CostTable::CostTable(const RoadView& view, int goal, Scratch& scratch)
    : goal_(goal),
      left_(static_cast<std::size_t>(view.arcs()), kNoWay),
      next_(static_cast<std::size_t>(view.arcs()), kArrived) {
    scratch.queue.reset(0, view.greatest_cost());
    for (const int arc : view.graph().in[static_cast<std::size_t>(goal)]) {
        reach(arc, 0, kArrived, scratch);
    }
    settle(view, scratch);
}

inline void CostTable::reach(int arc, RoadCost cost, int next, Scratch& scratch) {
    RoadCost& left = left_.data()[arc];
    if (cost >= left) return;
    left = cost;
    next_.data()[arc] = next;
    scratch.queue.push(cost, {arc, cost});
}

void CostTable::settle(const RoadView& view, Scratch& scratch) {
    std::uint32_t settled = 0;
    while (scratch.queue.least() != BucketQueue<Open>::kNone) {
        if (scratch.cancel && settled++ % kLookEvery == 0 && *scratch.cancel) {
            complete_ = false;
            return;
        }
        const Open top = scratch.queue.pop();
        if (top.cost != left(top.arc)) continue;  // reached at less since
        const RoadCost cost[] = {view.cost(top.arc, false), view.cost(top.arc, true)};
        if (cost[0] == kNoWay || top.cost >= kMostRoadCost) continue;
        for (const RoadView::Link before : view.before(top.arc)) {
            reach(before.arc(), top.cost + cost[before.turn() ? 1 : 0], top.arc, scratch);
        }
    }
}

void CostTable::repair(const RoadView& view, std::span<const int> arcs, Scratch& scratch) {
    // All whose way led over a changed arc know nothing any more, unless they get it again.
    auto& affected = scratch.affected;
    auto& is_affected = scratch.is_affected;
    affected.clear();
    is_affected.assign(left_.size(), 0);
    const auto forget_before = [&](int arc) {
        for (const RoadView::Link before : view.before(arc)) {
            const auto i = static_cast<std::size_t>(before.arc());
            if (next_[i] != arc || is_affected[i] != 0) continue;
            is_affected[i] = 1;
            affected.push_back(before.arc());
        }
    };
    for (const int arc : arcs) forget_before(arc);
    for (std::size_t i = 0; i < affected.size(); ++i) forget_before(affected[i]);
    for (const int arc : affected) left_[static_cast<std::size_t>(arc)] = kNoWay;

    // Their best continuation among the others, and what the changed arcs now offer to anyone; the
    // queue's keys then begin at the least of these and lie anywhere above.
    const auto offer = [&](int arc, auto take) {
        for (const RoadView::Link after : view.after(arc)) {
            const RoadCost rest = left(after.arc());
            const RoadCost way = view.cost(after.arc(), after.turn());
            if (rest >= kMostRoadCost || way == kNoWay) continue;
            take(rest + way, after.arc());
        }
    };
    std::vector<std::pair<Open, int>> first;
    for (const int arc : affected) {
        RoadCost best = kNoWay;
        int next = kArrived;
        offer(arc, [&](RoadCost cost, int over) {
            if (is_affected[static_cast<std::size_t>(over)] != 0 || cost >= best) return;
            best = cost;
            next = over;
        });
        if (best != kNoWay) first.push_back({{arc, best}, next});
    }
    for (const int arc : arcs) {
        const RoadCost rest = left(arc);
        if (rest >= kMostRoadCost) continue;
        for (const RoadView::Link before : view.before(arc)) {
            const RoadCost way = view.cost(arc, before.turn());
            if (way != kNoWay && rest + way < left(before.arc())) {
                first.push_back({{before.arc(), rest + way}, arc});
            }
        }
    }
    if (first.empty()) return;
    RoadCost least = kNoWay;
    RoadCost most = 0;
    for (const auto& [open, next] : first) {
        least = std::min(least, open.cost);
        most = std::max(most, open.cost);
    }
    scratch.queue.reset(least, most - least + view.greatest_cost());
    for (const auto& [open, next] : first) reach(open.arc, open.cost, next, scratch);
    settle(view, scratch);
}

}  // namespace pulseline::planning
