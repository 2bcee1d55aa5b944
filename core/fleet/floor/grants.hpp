#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Floor that a vehicle is given, and what it frees: the joint plan step by step.
namespace pulseline::fleet {

/// The leg ends here with the stop; a plan that gives way first ends elsewhere.
bool stands_at_stop(const FleetState& fleet, const LiveVehicle& live);
/// The leg ended beside all places without its stop, so no plan leads on from there.
bool is_dead_end(const FleetState& fleet, const LiveVehicle& live);
/// REQUIRES: the leg has no plan. At the end of its base, and who bars the rest has no plan to
/// leave (maybe because of this one), or has made it make way: it goes elsewhere only without its
/// leg.
bool is_stuck(const FleetState& fleet, const LiveVehicle& live);
/// The rest of the vehicle's plan is the graph's alone.
bool goes_by_places(const FleetState& fleet, const LiveVehicle& live);
/// Grants moves so that nodes up to `wanted_node` are in the base, as far as traffic lets it;
/// returns the number of released nodes.
std::size_t grant_nodes(FleetState& fleet, LiveVehicle& live, std::size_t wanted_node, Time now);
/// Nodes up to leg.passed_nodes are behind the vehicle.
void pass_nodes(FleetState& fleet, LiveVehicle& live, Time now);
/// The stop of the leg is made.
void pass_stop(FleetState& fleet, LiveVehicle& live, Time now);
/// It stands where it cannot rest with what it has brought, until others need the floor.
bool is_at_work(const FleetState& fleet, const LiveVehicle& live);
/// The floor is needed: its way to a resting place comes next.
void end_work(FleetState& fleet, LiveVehicle& live, Time now);
/// The task is given up where the vehicle stands without a leg.
void give_up_task(FleetState& fleet, LiveVehicle& live, Time now);
/// Vehicles that cannot move hold their floor and are planned around.
void halt_those_that_cannot_move(FleetState& fleet, Time now);
/// Its order has no way at present and is tried again.
bool tries_in_vain(const FleetState& fleet, const LiveVehicle& live);
/// Who waits tries other ways, about once a second.
void improve_floor(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
