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
    RoadPreferences preferences{cost};
    preferences.round_down = true;  // a bound must never lie above the truth
    return preferences;
}

std::vector<LaneRules> rules_of(const RoadmapIndex& roads, const Passage& passage) {
    std::vector<LaneRules> rules(roads.graph().arcs.size());
    for (std::size_t i = 0; i < rules.size(); ++i) {
        rules[i].too_narrow = passage.arc_free[i] == 0;
        if (passage.arc_allowed[i] == 0) rules[i].classes = 0;
    }
    return rules;
}

bool near(const geometry::Box& box, const geometry::Box& other, double within_m) {
    const double dx = std::max(box.min.x_m - other.max.x_m, other.min.x_m - box.max.x_m);
    const double dy = std::max(box.min.y_m - other.max.y_m, other.min.y_m - box.max.y_m);
    return std::max(dx, dy) <= within_m;
}

bool meets(const ClosedFloor& closure, const std::vector<geometry::Polygon>& swept) {
    for (const auto& piece : swept) {
        const auto box = geometry::bounding_box(piece);
        for (const auto& closed : closure.pieces) {
            if (!near(box, geometry::bounding_box(closed), closure.margin_m)) continue;
            if (geometry::distance(piece, closed) <= closure.margin_m) return true;
        }
    }
    return false;
}

/// The floor of a lane: what the body sweeps on it, and its corridor.
std::vector<geometry::Polygon> floor_of_arc(const RoadmapIndex& roads, const Passage& passage,
                                            int arc, double reach_m) {
    auto floor = roads.swept(passage.body, arc);
    if (const auto& corridor = roads.edge_of_arc(arc).corridor) {
        const auto& nodes = roads.graph().nodes;
        const RoadArc& lane = roads.graph().arcs[static_cast<std::size_t>(arc)];
        floor.push_back(plant::corridor_band(nodes[static_cast<std::size_t>(lane.from)],
                                             nodes[static_cast<std::size_t>(lane.to)], *corridor,
                                             reach_m));
    }
    return floor;
}

/// Whether a body could touch any of them between two points: spares most lanes their sweep.
bool any_near(const std::vector<ClosedFloor>& closures, const plant::HallId& hall,
              geometry::Point2 from, geometry::Point2 to, double reach_m) {
    const auto way = geometry::bounding_box({from, to});
    return std::any_of(closures.begin(), closures.end(), [&](const ClosedFloor& closure) {
        return closure.hall == hall &&
               std::any_of(closure.pieces.begin(), closure.pieces.end(), [&](const auto& piece) {
                   return near(way, geometry::bounding_box(piece), reach_m + closure.margin_m);
               });
    });
}

}  // namespace

std::vector<std::size_t> driven_over(const std::vector<ClosedFloor>& closures,
                                     const plant::HallId& hall,
                                     const std::vector<geometry::Polygon>& swept) {
    std::vector<std::size_t> over;
    for (std::size_t i = 0; i < closures.size(); ++i) {
        if (closures[i].hall == hall && meets(closures[i], swept)) over.push_back(i);
    }
    return over;
}

std::vector<std::vector<std::size_t>> closures_over_arcs(const RoadmapIndex& roads,
                                                         const Passage& passage,
                                                         const std::vector<ClosedFloor>& closures) {
    const RoadGraph& graph = roads.graph();
    const double reach_m = plant::reach_m(passage.body.pieces);
    std::vector<std::vector<std::size_t>> over(graph.arcs.size());
    for (std::size_t i = 0; i < over.size(); ++i) {
        const int arc = static_cast<int>(i);
        const auto& hall = roads.node(graph.arcs[i].from).hall;
        const auto& from = graph.nodes[static_cast<std::size_t>(graph.arcs[i].from)];
        const auto& to = graph.nodes[static_cast<std::size_t>(graph.arcs[i].to)];
        const auto room = roads.edge_of_arc(arc).corridor.value_or(plant::Corridor{});
        const double within_m = std::max({reach_m, room.left_m, room.right_m});
        if (!roads.usable(passage, arc) || !any_near(closures, hall, from, to, within_m)) continue;
        over[i] = driven_over(closures, hall, floor_of_arc(roads, passage, arc, reach_m));
    }
    return over;
}

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
