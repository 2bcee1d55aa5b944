#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// Where vehicles say that they stand, and whether that can be true.
namespace pulseline::fleet {

/// Takes what `live.state` says of the pose, if it can be true after what was known (`before`).
/// Else, from then on and until a person has said where it stands, it counts as not known.
void handle_pose(FleetState& fleet, LiveVehicle& live, const vda5050::StateMessage& before,
                 Time now);
/// A vehicle that lost its pose and sees surveyed codes, or iGPS, is told where it stands. Nothing
/// moves by it. `before`: when it told its last state; its reflectors are looked for in the whole
/// hall with the first state of each second only.
void offer_seen_pose(FleetState& fleet, LiveVehicle& live, std::optional<Time> before, Time now);
/// Having claimed to be elsewhere it says again that it is where it was known to be, or that it
/// has gone on from there on its leg. A claim that only happens to lie on the leg is not that.
bool stands_where_known(const FleetState& fleet, const LiveVehicle& live, Time now);
/// A person has looked: it is where it says now.
void end_doubt(FleetState& fleet, LiveVehicle& live, Time now);
/// After a restart: both floors, and the leg is given up as it was to be before.
void keep_doubt(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
