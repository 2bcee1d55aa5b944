#include "core/planning/roads/road_router.hpp"

#include <algorithm>

namespace pulseline::planning {
namespace {

constexpr std::size_t kMostChanges = 1u
                                     << 20;  // then tables are dropped, not to keep them for ever

}  // namespace

RoadRouter::RoadRouter(RoadGraph graph, std::vector<LaneRules> rules,
                       const RoadPreferences& preferences)
    : graph_(std::move(graph)), rules_(std::move(rules)), preferences_(preferences) {
    rules_.resize(graph_.arcs.size());
}

int RoadRouter::add_user(RoadUser user) {
    users_.push_back(std::make_unique<User>(graph_, rules_, preferences_, std::move(user)));
    return static_cast<int>(users_.size()) - 1;
}

void RoadRouter::set_rules(int arc, const LaneRules& rules) {
    LaneRules& known = rules_[static_cast<std::size_t>(arc)];
    if (known == rules) return;
    known = rules;
    for (const auto& user : users_) user->view.update(arc, rules);
    changed_.push_back(arc);
    if (changed_.size() < kMostChanges) return;
    changed_.clear();
    for (const auto& user : users_) {
        for (auto& kept : user->tables) kept.reset();
    }
}

void RoadRouter::set_closed(int arc, bool closed) {
    LaneRules rules = rules_[static_cast<std::size_t>(arc)];
    rules.closed = closed;
    set_rules(arc, rules);
}

const CostTable& RoadRouter::table(int user, int goal) {
    User& of = *users_[static_cast<std::size_t>(user)];
    auto& kept = of.tables[static_cast<std::size_t>(goal)];
    if (!kept) {
        kept = std::make_unique<Kept>(Kept{CostTable(of.view, goal, scratch_), changed_.size()});
    } else if (kept->seen != changed_.size()) {
        // A repair looks at every change; past this many the whole table is no dearer.
        constexpr std::size_t kMostRepairs = 256;
        const auto since = std::span(changed_).subspan(kept->seen);
        if (since.size() > kMostRepairs) {
            kept->table = CostTable(of.view, goal, scratch_);
        } else {
            kept->table.repair(of.view, since, scratch_);
        }
        kept->seen = changed_.size();
    }
    return kept->table;
}

bool RoadRouter::prepare(int user, int goal, const std::atomic<bool>* cancel) {
    scratch_.cancel = cancel;
    const bool complete = table(user, goal).complete();
    scratch_.cancel = nullptr;
    if (!complete) {
        users_[static_cast<std::size_t>(user)]->tables[static_cast<std::size_t>(goal)].reset();
    }
    return complete;
}

/// Of driving onto an arc out of the start; kNoWay when it is barred.
RoadCost RoadRouter::first_cost(const RoadView& view, const RoadStart& start, int arc) const {
    const bool turn = start.heading_rad &&
                      is_turn(preferences_.cost, *start.heading_rad, view.arc(arc).heading_rad);
    return view.cost(arc, turn);
}

RoadCost RoadRouter::cost(int user, const RoadStart& start, int goal) {
    if (start.node == goal) return 0;
    const CostTable& to_goal = table(user, goal);
    const RoadView& of = view(user);
    RoadCost best = kNoWay;
    for (const int arc : graph_.out[static_cast<std::size_t>(start.node)]) {
        const RoadCost first = first_cost(of, start, arc);
        const RoadCost rest = to_goal.left(arc);
        if (first != kNoWay && rest < kMostRoadCost) best = std::min(best, first + rest);
    }
    return best;
}

bool RoadRouter::find(int user, const RoadStart& start, int goal, RoadRoute& route) {
    route.cost = 0;
    route.length_m = 0;
    route.turns = 0;
    route.arcs.clear();
    if (start.node == goal) return true;
    const CostTable& to_goal = table(user, goal);
    const RoadView& of = view(user);
    route.cost = kNoWay;
    int at = -1;
    for (const int arc : graph_.out[static_cast<std::size_t>(start.node)]) {
        const RoadCost first = first_cost(of, start, arc);
        const RoadCost rest = to_goal.left(arc);
        if (first == kNoWay || rest >= kMostRoadCost || first + rest >= route.cost) continue;
        route.cost = first + rest;
        at = arc;
    }
    std::optional<double> heading = start.heading_rad;
    for (; at >= 0; at = to_goal.next(at)) {
        const RoadArc& arc = of.arc(at);
        route.arcs.push_back(at);
        route.length_m += arc.length_m;
        route.turns += heading && is_turn(preferences_.cost, *heading, arc.heading_rad) ? 1 : 0;
        heading = arc.heading_rad;
    }
    return route.cost != kNoWay;
}

void RoadRouter::costs(int user, std::span<const RoadStart> starts, std::span<const int> goals,
                       std::vector<RoadCost>& matrix) {
    // What the first arcs cost does not depend on the goal.
    struct First {
        int arc;
        RoadCost cost;
    };
    std::vector<First> first;
    std::vector<std::size_t> begin{0};
    for (const RoadStart& start : starts) {
        for (const int arc : graph_.out[static_cast<std::size_t>(start.node)]) {
            const RoadCost onto = first_cost(view(user), start, arc);
            if (onto != kNoWay) first.push_back({arc, onto});
        }
        begin.push_back(first.size());
    }
    // Many orders go to few stations: one column for each, its starts side by side.
    std::vector<int> distinct(goals.begin(), goals.end());
    std::sort(distinct.begin(), distinct.end());
    distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
    std::vector<RoadCost> columns(distinct.size() * starts.size(), kNoWay);
    for (std::size_t d = 0; d < distinct.size(); ++d) {
        const CostTable& to_goal = table(user, distinct[d]);
        RoadCost* column = columns.data() + d * starts.size();
        for (std::size_t s = 0; s < starts.size(); ++s) {
            RoadCost best = starts[s].node == distinct[d] ? 0 : kNoWay;
            for (std::size_t i = begin[s]; i < begin[s + 1]; ++i) {
                const RoadCost rest = to_goal.left(first[i].arc);
                if (rest < kMostRoadCost) best = std::min(best, first[i].cost + rest);
            }
            column[s] = best;
        }
    }
    matrix.resize(starts.size() * goals.size());
    for (std::size_t g = 0; g < goals.size(); ++g) {
        const auto found = std::lower_bound(distinct.begin(), distinct.end(), goals[g]);
        const RoadCost* column =
            columns.data() + static_cast<std::size_t>(found - distinct.begin()) * starts.size();
        for (std::size_t s = 0; s < starts.size(); ++s) matrix[s * goals.size() + g] = column[s];
    }
}

std::size_t RoadRouter::bytes() const {
    std::size_t sum = rules_.size() * sizeof(LaneRules) + scratch_.queue.bytes();
    for (const auto& user : users_) {
        sum += user->view.bytes();
        for (const auto& kept : user->tables) sum += kept ? kept->table.bytes() : 0;
    }
    return sum;
}

}  // namespace pulseline::planning
