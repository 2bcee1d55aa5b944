#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// How a leg, which is nodes and edges for its vehicle, gets its moves in the joint plan, and
/// follows when those are planned anew.
namespace pulseline::fleet {

/// Takes the rest of the vehicle's leg (all behind its base) into the joint plan. Nothing is
/// changed when there is no plan: the reason says who or what is in the way. The leg's horizon may
/// come out different: another way, when its own is blocked for good.
std::optional<Reason> plan_on_floor(FleetState& fleet, LiveVehicle& live, Time now);
/// A leg of one node becomes the drive that the vehicle's plan already has.
void take_plan_as_leg(FleetState& fleet, LiveVehicle& live);
/// Brings the legs of all vehicles with new plans up to date and tells those on the way.
void follow_replans(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
