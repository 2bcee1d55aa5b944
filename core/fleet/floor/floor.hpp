#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// The floor of a vehicle's body and of its leg, and who is in its way there.
namespace pulseline::fleet {

/// Floor under the vehicle's outline at a pose, position error included.
traffic::TileSet floor_under(const FleetState& fleet, const LiveVehicle& live, const Pose2& pose);
/// Floor of an edge of the vehicle's leg: what it sweeps there, and the edge's corridor.
traffic::TileSet floor_of_edge(const FleetState& fleet, const LiveVehicle& live,
                               const vda5050::OrderEdge& edge);
/// Floor in which the vehicle stands when it stops at node `i` of its leg.
traffic::TileSet floor_at_node(const FleetState& fleet, const LiveVehicle& live, std::size_t i);
/// Whether it makes way for others where it stands.
traffic::Leaves leaves(const FleetState& fleet, const LiveVehicle& live);
void halt_or_resume(FleetState& fleet, LiveVehicle& live, Time now);

/// Why the vehicle's next move is not granted; none: it is, or there is none.
std::optional<Reason> floor_wait(const FleetState& fleet, const LiveVehicle& live);
Reason floor_reason(const FleetState& fleet, const traffic::Block& block);
/// The class of the plant's tables that the vehicle moves on the floor as.
const FloorClass& floor_class_of(const FleetState& fleet, const LiveVehicle& live);
/// Number of the move that ends at a node of the vehicle's leg.
traffic::MoveNumber move_of_node(const LiveVehicle& live, std::size_t node);

}  // namespace pulseline::fleet
