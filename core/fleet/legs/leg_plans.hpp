#pragma once

#include "core/fleet/state/fleet_state.hpp"
#include "core/planning/legs/leg_planner.hpp"

/// Legs that take longer to plan than others may wait for the fleet: free manoeuvres, some tens of
/// milliseconds each and half a second where there is hardly room. The fleet asks for such a plan
/// (Outputs::plans_wanted), the order waits (plan_under_way), and Fleet::leg_planned brings the
/// answer. It is an input, so a journal made again gives the same.
namespace pulseline::fleet {

/// Plans a leg as far as the fleet does that itself. Errors: those of LegPlanner; kNeedsPlan
/// (plan_under_way) for one that only a free manoeuvre may do.
Result<planning::LegPlan> plan_here(const FleetState& fleet, const planning::LegRequest& request);
/// The plan of a vehicle's next leg; what is not planned here is asked for, once more when it takes
/// long. Errors: as before; why there is no way, once that has been told.
Result<planning::LegPlan> plan_or_ask(FleetState& fleet, LiveVehicle& live,
                                      const planning::LegRequest& request, Time now);

/// When the plan of its next leg has been barred for a while: another is asked for, and the known
/// one counts until then.
void ask_anew(FleetState& fleet, LiveVehicle& live, Time now);

}  // namespace pulseline::fleet
