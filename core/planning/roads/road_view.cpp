#include "core/planning/roads/road_view.hpp"

#include <algorithm>

namespace pulseline::planning {

RoadView::RoadView(const RoadGraph& graph, const std::vector<LaneRules>& rules,
                   const RoadPreferences& preferences, RoadUser user)
    : graph_(graph), preferences_(preferences), user_(std::move(user)) {
    const auto node = [](int index) { return static_cast<std::size_t>(index); };
    const auto link = [&](int from, int to, int named) {
        const bool turn = is_turn(preferences_.cost, arc(from).heading_rad, arc(to).heading_rad);
        return Link{static_cast<std::uint32_t>(named) * 2 + (turn ? 1u : 0u)};
    };
    const auto may = [&](int from, int to) {
        return !user_.may_follow || user_.may_follow(from, to);
    };
    for (int a = 0; a < arcs(); ++a) {
        before_begin_.push_back(static_cast<std::uint32_t>(before_.size()));
        for (const int p : graph.in[node(arc(a).from)]) {
            if (may(p, a)) before_.push_back(link(p, a, p));
        }
        after_begin_.push_back(static_cast<std::uint32_t>(after_.size()));
        for (const int n : graph.out[node(arc(a).to)]) {
            if (may(a, n)) after_.push_back(link(a, n, n));
        }
    }
    before_begin_.push_back(static_cast<std::uint32_t>(before_.size()));
    after_begin_.push_back(static_cast<std::uint32_t>(after_.size()));
    costs_.assign(graph.arcs.size() * 2, kNoWay);
    for (int a = 0; a < arcs(); ++a) update(a, rules[static_cast<std::size_t>(a)]);
}

void RoadView::update(int index, const LaneRules& rules) {
    const auto i = static_cast<std::size_t>(index) * 2;
    costs_[i] = costs_[i + 1] = kNoWay;
    if (bar_of(rules, user_) != Bar::kNone) return;
    const ArcCost cost = arc_cost(preferences_, arc(index), rules, user_);
    costs_[i] = cost.straight();
    costs_[i + 1] = cost.turned();
    greatest_ = std::max({greatest_, cost.straight(), cost.turned()});
}

std::size_t RoadView::bytes() const {
    return (before_.size() + after_.size()) * sizeof(Link) +
           (before_begin_.size() + after_begin_.size()) * sizeof(std::uint32_t) +
           costs_.size() * sizeof(RoadCost);
}

}  // namespace pulseline::planning
