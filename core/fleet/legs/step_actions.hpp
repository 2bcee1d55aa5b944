#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// The actions before and after a step. They are sent as the node actions of a leg of their own
/// that does not move: the drive begins only when all before it are finished, and what comes after
/// begins only when the stop is inside its tolerance. A failed one leaves the order to a person;
/// what is finished is not sent again. A load is taken over or set down in a leg of its own: the
/// floor below it is held before, and where it is changes with the end.
namespace pulseline::fleet {

/// The vehicle does something standing next.
bool acts_next(const JobOrder& order, const LiveVehicle& live);
/// That the present step asks for next, and that takes a load over or sets it down; nullptr: none.
const StepAction* next_transfer(const JobOrder& order, const LiveVehicle& live);
/// Before the leg of a transfer: the floor below the load is held with it. A reason: others have
/// it. Errors: those of may_transfer, which a person has to put right.
Result<std::optional<Reason>> prepare_transfer(FleetState& fleet, const JobOrder& order,
                                               LiveVehicle& live, Time now);
/// The leg that does what the present step asks for now; nullopt: it is time to drive.
std::optional<Leg> next_actions_leg(const FleetState& fleet, JobOrder& order,
                                    const LiveVehicle& live, LegId id);
/// Of such a leg that is to be given up: what the vehicle did before it heard of that is done, and
/// a load that it moved is where it is. Before the leg ends.
void count_done_before_cancel(FleetState& fleet, LiveVehicle& live, Time now);
/// What the vehicle reports of a leg with Leg::actions_only.
void take_actions_leg(FleetState& fleet, LiveVehicle& live, Time now);
/// The step's stop is inside its tolerance: its actions follow, or it is done.
void handle_good_stop(FleetState& fleet, JobOrder& order, std::size_t step, Time now);

}  // namespace pulseline::fleet
