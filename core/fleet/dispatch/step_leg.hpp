#pragma once

#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {

struct StepLeg {
    Leg leg;
    bool corrects = false;  // the vehicle is as good as there: only its stop is corrected
};

/// The next leg of an order's present step: its actions, a correction of the stop, or the drive.
/// Errors: kNeedsPlan {its reason} while a plan is made beside the fleet; those of the planner.
Result<StepLeg> leg_of_step(FleetState& fleet, JobOrder& order, LiveVehicle& live,
                            const plant::Station& station, LegId id, Time now);

/// A station that closed floor cuts off: names what would have to be reopened, not just the first
/// of it.
void name_what_cuts_off(FleetState& fleet, LiveVehicle& live, const Step& step, Reason& reason,
                        Time now);

}  // namespace pulseline::fleet
