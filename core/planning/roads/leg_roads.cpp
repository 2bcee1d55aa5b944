#include "core/planning/roads/leg_roads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planning/search/routing_cost.hpp"

namespace pulseline::planning {
namespace {

// A metre costs about this much to the router: thousandths of it are fine enough, and 200 km fit.
constexpr double kOwnK = 10;

/// Legs are refused where the plant's costs are no costs at all; the tables must be made none the
/// less.
plant::RoutingCost sane(const plant::RoutingCost& cost) {
    return check(cost) ? cost : plant::RoutingCost{};
}

double unit_of(const plant::RoutingCost& cost) {
    const double charge = std::abs(cost.k_diff - cost.k_same) * cost.reference_step_m;
    const double most = std::max(cost.k_same, charge);
    return most > 0 && std::isfinite(most) ? most / kOwnK : 1;
}

RoadPreferences scaled(plant::RoutingCost cost, double unit) {
    cost.k_same /= unit;
    cost.k_diff /= unit;
    cost.accuracy_k /= unit;
    RoadPreferences preferences{cost};
    preferences.round_down = true;  // a bound must never lie above the truth
    return preferences;
}

std::vector<LaneRules> rules_of(const RoadmapIndex& roads, const Passage& passage) {
    std::vector<LaneRules> rules(roads.graph().arcs.size());
    for (std::size_t i = 0; i < rules.size(); ++i) {
        rules[i].too_narrow = passage.arc_free[i] == 0;
        if (passage.arc_allowed[i] == 0) rules[i].classes = 0;
        rules[i].sigma_m = passage.sigma_m(static_cast<int>(i));
    }
    return rules;
}

}  // namespace

LegRoads::LegRoads(const RoadmapIndex& roads, const Passage& passage,
                   const plant::RoutingCost& cost)
    : roads_(roads),
      passage_(passage),
      unit_(unit_of(sane(cost))),
      router_(roads.graph(), rules_of(roads, passage), scaled(sane(cost), unit_)),
      over_(roads.graph().arcs.size()) {
    RoadUser user;
    user.may_follow = [this](int arc, int next) { return roads_.may_follow(passage_, arc, next); };
    user_ = router_.add_user(std::move(user));
}

void LegRoads::set_closures(const std::vector<ClosedFloor>& closures) {
    over_ = closures_over_arcs(roads_, passage_, closures);
    for (std::size_t i = 0; i < over_.size(); ++i) {
        router_.set_closed(static_cast<int>(i), !over_[i].empty());
    }
}

LegRoads::Left LegRoads::left(int goal) {
    Left left;
    left.table_ = &router_.table(user_, goal);
    left.unit_ = unit_;
    return left;
}

double LegRoads::Left::after(int arc) const {
    const RoadCost left = table_->left(arc);
    if (left >= kMostRoadCost) return std::numeric_limits<double>::infinity();
    // Sums of doubles in another order must not come out below it either.
    return std::max(0.0, unit_ * (left * (1 - 1e-9) / kCostUnit - 1e-7));
}

RoadCost LegRoads::counted(double cost_k) const {
    const double counted = cost_k / unit_ * kCostUnit;
    return counted < kMostRoadCost ? static_cast<RoadCost>(std::max(0.0, counted)) : kNoWay;
}

}  // namespace pulseline::planning
