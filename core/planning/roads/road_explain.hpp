#pragma once

#include <optional>
#include <vector>

#include "core/planning/roads/road_router.hpp"

/// Why a route is what it is: what each arc costs and for what, what an alternative would cost
/// more, what bars a shorter one, and what would have to be opened where there is none.
namespace pulseline::planning {

/// Costs in thousandths of k.
struct RouteLegCost {
    int arc = 0;
    double length_m = 0;
    bool turn = false;  // a change of direction before it
    std::int64_t length = 0;
    std::int64_t turns = 0;
    std::int64_t speed = 0;
    std::int64_t accuracy = 0;
    std::int64_t total() const { return length + turns + speed + accuracy; }
};
std::vector<RouteLegCost> leg_costs(const RoadRouter& router, int user, const RoadStart& start,
                                    const std::vector<int>& arcs);

/// How another route differs from the chosen one: positive is more.
struct RouteDifference {
    std::int64_t length = 0;
    std::int64_t turns = 0;
    std::int64_t speed = 0;
    std::int64_t accuracy = 0;
    std::int64_t total() const { return length + turns + speed + accuracy; }
    enum class Reason : std::uint8_t { kLength, kTurns, kSpeed, kAccuracy };
    /// What most speaks against the other one.
    Reason main_reason() const;
};
RouteDifference difference(const std::vector<RouteLegCost>& chosen,
                           const std::vector<RouteLegCost>& other);

struct BarredArc {
    int arc = 0;
    Bar bar = Bar::kNone;
};
/// The least-cost route if nothing were closed or barred to the user, and what bars it; nullopt
/// when that is no cheaper than `cost`.
struct BarredRoute {
    RoadRoute route;
    std::vector<BarredArc> bars;
};
std::optional<BarredRoute> barred_shortcut(const RoadRouter& router, int user,
                                           const RoadStart& start, int goal, RoadCost cost);

/// A smallest set of arcs that must be opened to the user so that a route exists (of equally small
/// ones that of the cheapest route), or nullopt when no lanes lead there at all. Empty: a route
/// exists. Dijkstra over arcs by (barred arcs driven, cost).
std::optional<std::vector<BarredArc>> blocking_set(const RoadRouter& router, int user,
                                                   const RoadStart& start, int goal);

}  // namespace pulseline::planning
