#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "core/planning/roads/cost_table.hpp"

namespace pulseline::planning {

/// A place on the roadmap from which a vehicle sets out.
struct RoadStart {
    int node = 0;
    std::optional<double> heading_rad;  // of travel; none: the first arc is no turn
};

struct RoadRoute {
    RoadCost cost = 0;  // thousandths of k
    double length_m = 0;
    int turns = 0;
    std::vector<int> arcs;
};

/// Exact routes and dispatch costs on a roadmap to a fixed set of goals, for several kinds of
/// users.
///
/// Tables are built when a goal is first asked for and follow closures and other changes of lanes
/// when they are next used: a change costs nothing by itself, and a query never answers with what
/// was. Thread safety: none; one router per thread, or const methods of a CostTable held.
class RoadRouter {
public:
    RoadRouter(RoadGraph graph, std::vector<LaneRules> rules, const RoadPreferences& preferences);

    /// Registers a kind of user; its number stands for it in queries.
    int add_user(RoadUser user);

    // Edits; REQUIRES: arc in the graph.
    void set_rules(int arc, const LaneRules& rules);
    void set_closed(int arc, bool closed);

    /// Brings the goal's table up to date, which is all that takes time in the queries below. False
    /// when `cancel` was set meanwhile; nothing half made is kept.
    bool prepare(int user, int goal, const std::atomic<bool>* cancel);
    /// Least-cost route; false without one. `route` is used again: no allocation once it is warm.
    bool find(int user, const RoadStart& start, int goal, RoadRoute& route);
    /// Its cost alone; kNoWay without one.
    RoadCost cost(int user, const RoadStart& start, int goal);
    /// From every start to every goal, by start then goal.
    void costs(int user, std::span<const RoadStart> starts, std::span<const int> goals,
               std::vector<RoadCost>& matrix);

    /// Up to date; valid until the next edit.
    const CostTable& table(int user, int goal);
    const RoadView& view(int user) const { return users_[static_cast<std::size_t>(user)]->view; }
    const RoadGraph& graph() const { return graph_; }
    const LaneRules& rules(int arc) const { return rules_[static_cast<std::size_t>(arc)]; }
    std::size_t bytes() const;

private:
    struct Kept {
        CostTable table;
        std::size_t seen = 0;  // changes it has followed
    };
    struct User {
        User(const RoadGraph& graph, const std::vector<LaneRules>& rules,
             const RoadPreferences& preferences, RoadUser user)
            : view(graph, rules, preferences, std::move(user)), tables(graph.nodes.size()) {}
        RoadView view;
        std::vector<std::unique_ptr<Kept>> tables;  // by goal
    };

    RoadCost first_cost(const RoadView& view, const RoadStart& start, int arc) const;

    RoadGraph graph_;
    std::vector<LaneRules> rules_;
    RoadPreferences preferences_;
    std::vector<std::unique_ptr<User>> users_;
    std::vector<int> changed_;  // arcs, in the order of the edits
    CostTable::Scratch scratch_;
};

}  // namespace pulseline::planning
