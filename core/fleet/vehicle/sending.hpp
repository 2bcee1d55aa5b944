#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// What is sent to a vehicle, again until it has shown that it has it.
namespace pulseline::fleet {

void send_order_update(FleetState& fleet, LiveVehicle& live, std::size_t from, Time now);
/// Asks the vehicle to give up its leg; the leg is dropped when it has confirmed and stands.
void cancel_leg(FleetState& fleet, LiveVehicle& live, Time now);
/// Sends startPause or stopPause; the newest wish counts.
void pause_motion(FleetState& fleet, LiveVehicle& live, const char* action_type, Time now);
/// After a person's act; the vehicle is not ready until that order is gone.
void cancel_foreign_order(FleetState& fleet, LiveVehicle& live, const std::string& actor, Time now);
void send_action(FleetState& fleet, LiveVehicle& live, vda5050::Action action, Time now);
void resend(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
