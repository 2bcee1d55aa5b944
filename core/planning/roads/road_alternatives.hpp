#pragma once

#include <vector>

#include "core/planning/roads/road_router.hpp"

namespace pulseline::planning {

struct AlternativesWanted {
    int count = 3;             // routes, the best included
    double most_shared = 0.6;  // share of a route's length that it may have in common with another
    double most_cost = 1.5;    // times the least cost
    const std::atomic<bool>* cancel = nullptr;  // set by anyone; then the answer means nothing
};

/// The best route and others sufficiently different from it and from each other, by cost. An
/// alternative is the best of all routes over one arc of its own: the least cost to that arc and
/// the table's from there ("via" routes: Abraham, Delling, Goldberg, Werneck, "Alternative Routes
/// in Road Networks", JEA 18, 2013), and passes no node twice. Costs one search forwards: for
/// people who choose, not for dispatch.
std::vector<RoadRoute> alternatives(RoadRouter& router, int user, const RoadStart& start, int goal,
                                    const AlternativesWanted& wanted);

/// One arc to set out on, and what it costs to have driven it.
struct RoadSeed {
    int arc = 0;
    RoadCost cost = 0;
};
/// The same for a vehicle that may set out in several ways: routes different from `chosen` (which
/// may be empty) and from each other, up to `wanted.count` without it.
std::vector<RoadRoute> other_routes(RoadRouter& router, int user,
                                    const std::vector<RoadSeed>& seeds, int goal,
                                    const RoadRoute& chosen, const AlternativesWanted& wanted);

}  // namespace pulseline::planning
