#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// A leg on its way to the vehicle: taken, planned on the floor, sent, extended.
namespace pulseline::fleet {

/// Releases as many further nodes as the vehicle needs to keep its speed and sends the update.
void extend_base(FleetState& fleet, LiveVehicle& live, Time now);
/// The vehicle gets this leg; nothing of it is sent yet.
void take_leg(LiveVehicle& live, Leg leg);
/// As take_leg, and plans its way on the floor (a leg of one node needs none). Nothing is changed
/// when there is no way: the reason says who or what is in it.
std::optional<Reason> try_leg(FleetState& fleet, LiveVehicle& live, Leg leg, Time now);
/// The first message of a leg just taken.
void send_leg(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
