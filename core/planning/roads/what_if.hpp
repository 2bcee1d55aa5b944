#pragma once

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/planning/roads/leg_roads.hpp"
#include "core/planning/roads/road_explain.hpp"
#include "core/planning/roads/roadmap_index.hpp"

/// What would be: a route over the plant's roadmap under changed circumstances, explained.
namespace pulseline::planning {

struct WhatIf {
    plant::VehicleTypeId vehicle_type;
    bool loaded = false;
    int from = 0;  // station numbers
    int to = 0;
    std::vector<plant::EdgeId> closed;
    bool present_closures = true;       // whether `closures` count
    std::vector<ClosedFloor> closures;  // floor that people have closed
    int alternatives = 2;
    const std::atomic<bool>* cancel = nullptr;  // set by anyone
};

struct WhatIfLeg {
    plant::EdgeId edge;
    plant::NodeId from;
    plant::NodeId to;
    bool backwards = false;
    double max_speed_mps = 0;  // 0: the vehicle's own
    RouteLegCost cost;
};
struct WhatIfRoute {
    RoadCost cost = 0;  // thousandths of k
    double length_m = 0;
    int turns = 0;
    std::vector<WhatIfLeg> legs;
};
struct WhatIfBar {
    plant::EdgeId edge;
    Bar bar = Bar::kNone;
    std::vector<std::size_t> closures;  // that it leads over, by their place in the question's
};
struct WhatIfAnswer {
    std::vector<WhatIfRoute> routes;           // the best first; empty: there is none
    std::vector<RouteDifference> differences;  // of the others from the best
    /// What bars the best route that there would be without closures, narrow lanes and lanes of
    /// other types; empty when that is no better.
    std::vector<WhatIfBar> shortcut_bars;
    RoadCost shortcut_cost = 0;
    /// Without a route: a smallest set of lanes to open; empty when no lanes lead there at all.
    std::vector<WhatIfBar> blocking;
};

/// Start heading free; turns at nodes only where the body has room. Works the plant's lanes out
/// anew for the vehicle type. Errors: unknown_vehicle_type, unknown_station, unknown_edge,
/// other_hall, cancelled.
Result<WhatIfAnswer> what_if(const plant::Plant& plant, const WhatIf& question);

}  // namespace pulseline::planning
