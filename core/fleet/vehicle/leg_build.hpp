#pragma once

#include <string>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// A planned drive as the nodes, edges and actions that the vehicle is sent.
namespace pulseline::fleet {

/// Says of each node behind the leg's base how far beside it the vehicle may pass.
void widen_nodes(Leg& leg);

/// The drive as nodes and edges; nothing released but nodes[0].
Leg build_leg(const FleetState& fleet, const LiveVehicle& live, const planning::LegPlan& plan,
              const plant::Station& station, const Pose2& start, LegId id);
/// Where a leg starts: the vehicle stands there, within what a measured stop may be off.
vda5050::OrderNode start_node(const Pose2& pose, const std::string& hall);
/// A leg that only measures and corrects where the vehicle stands (second approach).
Leg build_adjust_leg(const FleetState& fleet, const LiveVehicle& live,
                     const plant::Station& station, const Pose2& pose, LegId id);
/// What the vehicle does at the station node: correct the stop, then measure it.
std::vector<vda5050::Action> stop_actions(const FleetState& fleet, const LiveVehicle& live,
                                          const plant::Station& station, const LegId& leg);
/// What it does where it only rests: it takes away what odometry has gathered, and charges if the
/// leg is for that.
std::vector<vda5050::Action> rest_actions(const FleetState& fleet, const LiveVehicle& live,
                                          const plant::Station& station, const Leg& leg);

}  // namespace pulseline::fleet
