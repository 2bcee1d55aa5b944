#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// What a vehicle reports of its instant actions.
namespace pulseline::fleet {

bool is_final(vda5050::ActionStatus status);
/// What the vehicle says of an action; null: nothing.
const vda5050::ActionState* find_action(const vda5050::StateMessage& state, const std::string& id);
/// Ends the instant actions that the vehicle reports final, and what waited for them.
void handle_action_states(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
