#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/id.hpp"
#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/planning/leg_roads.hpp"
#include "core/plant/plant.hpp"
#include "core/traffic/record.hpp"

/// Floor that people close for a while: an area, or lanes of the roadmap.
namespace pulseline::fleet {

using ClosureId = Id<struct ClosureTag>;

struct Closure {
    ClosureId id;
    std::string name;  // what people call it, e.g. "Wet paint at door 3"
    plant::HallId hall;
    geometry::Polygon outline;         // hall frame; empty: only lanes are closed
    std::vector<plant::EdgeId> edges;  // lanes, in both directions only when both are named
    std::string created_by;
    Time created;
};

struct NewClosure {
    std::string name;
    plant::HallId hall;
    geometry::Polygon outline;
    std::vector<plant::EdgeId> edges;
};

struct FleetState;

Result<Closure> close_floor(FleetState& fleet, const NewClosure& wanted, const std::string& actor,
                            Time now);
Status reopen_floor(FleetState& fleet, ClosureId id, const std::string& actor, Time now);
/// Closes again what was closed when the server went down.
void restore_closures(FleetState& fleet, std::vector<Closure> closures, Time now);
/// What is closed, as planning takes it.
std::vector<planning::ClosedFloor> closed_floors(const FleetState& fleet);
/// Legs lead round closed floor from now on.
void close_to_planner(FleetState& fleet);
/// Puts closures into a reason as `closure` (names) and `closure_id`, instead of those it has.
void name_closures(const FleetState& fleet, const std::vector<std::string>& ids, Reason& reason);
/// The closure that holds a tile, to name it.
const Closure* closure_at(const FleetState& fleet, traffic::TileId tile);

}  // namespace pulseline::fleet
