#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// The actions before and after a step. They are sent as the node actions of a leg of their own
/// that does not move: the drive begins only when all before it are finished, and what comes after
/// begins only when the stop is inside its tolerance. A failed one leaves the order to a person;
/// what is finished is not sent again.
namespace pulseline::fleet {

/// The leg that does what the present step asks for now; nullopt: it is time to drive.
std::optional<Leg> next_actions_leg(const FleetState& fleet, JobOrder& order,
                                    const LiveVehicle& live, LegId id);
/// What the vehicle reports of a leg with Leg::actions_only.
void take_actions_leg(FleetState& fleet, LiveVehicle& live, Time now);
/// The step's stop is inside its tolerance: its actions follow, or it is done.
void handle_good_stop(FleetState& fleet, JobOrder& order, std::size_t step, Time now);

}  // namespace pulseline::fleet
