#pragma once

#include <span>
#include <vector>

#include "core/planning/roads/road_costs.hpp"

namespace pulseline::planning {

/// The roadmap as one kind of user sees it, packed for searches over directed arcs: which arcs may
/// follow which with or without a change of direction, and what each costs.
class RoadView {
public:
    /// REQUIRES: `rules` has one entry per arc; `graph` outlives the view unchanged.
    RoadView(const RoadGraph& graph, const std::vector<LaneRules>& rules,
             const RoadPreferences& preferences, RoadUser user);

    /// An arc that may come before (or after) another.
    struct Link {
        std::uint32_t packed;  // arc x 2 + whether a change of direction lies between
        int arc() const { return static_cast<int>(packed >> 1); }
        bool turn() const { return (packed & 1) != 0; }
    };
    std::span<const Link> before(int arc) const { return links(before_, before_begin_, arc); }
    std::span<const Link> after(int arc) const { return links(after_, after_begin_, arc); }

    /// Of driving an arc after a change of direction or without one; kNoWay when barred.
    RoadCost cost(int arc, bool turn) const {
        return costs_[static_cast<std::size_t>(arc) * 2 + (turn ? 1 : 0)];
    }
    RoadCost greatest_cost() const { return greatest_; }

    /// The rules of an arc have changed.
    void update(int arc, const LaneRules& rules);

    const RoadGraph& graph() const { return graph_; }
    const RoadUser& user() const { return user_; }
    const RoadPreferences& preferences() const { return preferences_; }
    int arcs() const { return static_cast<int>(graph_.arcs.size()); }
    const RoadArc& arc(int index) const { return graph_.arcs[static_cast<std::size_t>(index)]; }
    std::size_t bytes() const;

private:
    std::span<const Link> links(const std::vector<Link>& all, const std::vector<std::uint32_t>& at,
                                int arc) const {
        const auto i = static_cast<std::size_t>(arc);
        return std::span(all).subspan(at[i], at[i + 1] - at[i]);
    }

    const RoadGraph& graph_;
    RoadPreferences preferences_;
    RoadUser user_;
    std::vector<Link> before_;
    std::vector<Link> after_;
    std::vector<std::uint32_t> before_begin_;
    std::vector<std::uint32_t> after_begin_;
    std::vector<RoadCost> costs_;
    RoadCost greatest_ = 0;
};

}  // namespace pulseline::planning
