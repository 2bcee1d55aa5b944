#pragma once

#include "core/fleet/state/fleet_state.hpp"

/// How long a vehicle has been silent, and what follows of it.
namespace pulseline::fleet {

// Of silence; what each of them means stands beside Link.
constexpr Duration kLateAfter = std::chrono::seconds(2);
constexpr Duration kLostAfter = std::chrono::seconds(10);
constexpr Duration kGoneAfter = std::chrono::seconds(60);

void connect(FleetState& fleet, LiveVehicle& live, Time now);
void disconnect(FleetState& fleet, LiveVehicle& live, Time now);
void note_heard(FleetState& fleet, LiveVehicle& live, Time now);
void update_links(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
