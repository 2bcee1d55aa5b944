#pragma once

#include <string>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Floor that people close for a while, as planning and traffic know it.
namespace pulseline::fleet {

Result<Closure> close_floor(FleetState& fleet, const NewClosure& wanted, const std::string& actor,
                            Time now);
Status reopen_floor(FleetState& fleet, ClosureId id, const std::string& actor, Time now);
/// Closes again what was closed when the server went down.
void restore_closures(FleetState& fleet, std::vector<Closure> closures, Time now);
/// The same for who carries something, where loads stand: after any of them has moved.
void close_below_loads(FleetState& fleet, Time now);
/// What is closed, as planning takes it.
std::vector<planning::ClosedFloor> closed_floors(const FleetState& fleet);
/// Legs lead round closed floor from now on.
void close_to_planner(FleetState& fleet);
/// Puts closures into a reason as `closure` (names) and `closure_id`, instead of those it has.
void name_closures(const FleetState& fleet, const std::vector<std::string>& ids, Reason& reason);
/// The closure that holds a tile, to name it.
const Closure* closure_at(const FleetState& fleet, traffic::TileId tile);

}  // namespace pulseline::fleet
