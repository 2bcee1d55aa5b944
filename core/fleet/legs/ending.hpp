#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// The ways in which a leg ends that was not driven to its end, and what becomes of its order.
namespace pulseline::fleet {

/// Forgets the leg; the vehicle keeps the floor it stands on. `arrived`: and the rest of its plan.
void drop_leg(FleetState& fleet, VehicleRun& run, Time now, bool arrived = false);
/// The vehicle does not have its leg any more. Until it knows its pose it may stand anywhere on the
/// base, which only the leg remembers over a restart: so long the leg is kept.
void forget_leg(FleetState& fleet, VehicleRun& run, Time now);
/// Ends an order whose vehicle has nothing to do for it any more: Ended after a Stop, else Aborted.
void abort_order(FleetState& fleet, JobOrder& order, Reason reason, const std::string& actor,
                 Time now);
/// The running order of a vehicle that is taken out waits for a person.
void interrupt(FleetState& fleet, const VehicleRun& run, const std::string& actor, Time now);
/// The vehicle has given up its leg and stands.
void finish_cancel(FleetState& fleet, VehicleRun& run, Time now);

}  // namespace pulseline::fleet
