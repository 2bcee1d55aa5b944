#include "core/planning/roads/road_costs.hpp"

#include <algorithm>
#include <cmath>

#include "core/planning/search/routing_cost.hpp"

namespace pulseline::planning {
namespace {

// So that a route of a hundred arcs stays far inside 32 bits.
constexpr double kMostArcCost = 1 << 24;

RoadCost rounded(double cost_k, bool down) {
    const double cost = std::clamp(cost_k * kCostUnit, 0.0, kMostArcCost);
    return static_cast<RoadCost>(down ? std::floor(cost) : std::round(cost));
}

/// A saving is rounded the other way.
RoadCost saved(double cost_k, bool down) {
    const double cost = std::clamp(cost_k * kCostUnit, 0.0, kMostArcCost);
    return static_cast<RoadCost>(down ? std::ceil(cost) : std::round(cost));
}

/// 0: no limit.
double speed_of(const LaneRules& rules, const RoadUser& user) {
    double least = 0;
    const auto limit = [&](double speed_mps) {
        if (speed_mps > 0 && (least == 0 || speed_mps < least)) least = speed_mps;
    };
    limit(rules.max_speed_mps);
    if (user.loaded) limit(rules.max_speed_loaded_mps);
    limit(user.max_speed_mps);
    return least;
}

}  // namespace

ArcCost arc_cost(const RoadPreferences& preferences, const RoadArc& arc, const LaneRules& rules,
                 const RoadUser& user) {
    const plant::RoutingCost& k = preferences.cost;
    const bool down = preferences.round_down;
    ArcCost cost;
    const double way = k.k_same * arc.length_m;
    cost.length = rounded(way, down);
    const double speed = speed_of(rules, user);
    if (speed > 0 && speed < preferences.reference_speed_mps) {
        cost.speed = rounded(way * (preferences.reference_speed_mps / speed - 1), down);
    }
    cost.accuracy = rounded(k.accuracy_k * rules.sigma_m * arc.length_m, down);
    const double turn = (k.k_diff - k.k_same) * k.reference_step_m;
    cost.turn = turn >= 0 ? std::int64_t{rounded(turn, down)}
                          : -std::int64_t{std::min(saved(-turn, down), cost.straight())};
    return cost;
}

Bar bar_of(const LaneRules& rules, const RoadUser& user) {
    if (rules.closed) return Bar::kClosed;
    if ((rules.classes & user.vehicle_class) == 0) return Bar::kClass;
    return rules.too_narrow ? Bar::kTooNarrow : Bar::kNone;
}

}  // namespace pulseline::planning
