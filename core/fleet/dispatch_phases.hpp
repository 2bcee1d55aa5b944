#pragma once

#include <vector>

#include "core/fleet/state.hpp"

/// The phases of dispatch, one file each; dispatch.cpp says in which order they run.
namespace pulseline::fleet {

/// Open orders in a state, highest priority first, then the oldest.
std::vector<JobOrder*> by_urgency(FleetState& fleet, JobState state);

/// Vehicles at work get further base (extend_bases.cpp).
void extend_bases(FleetState& fleet, Time now);
bool may_extend_base(const VehicleRun& run, Time now);
/// Free vehicles get waiting orders: one assignment of least cost (assign_waiting.cpp).
void assign_waiting(FleetState& fleet, Time now);
/// Assigned orders start their next step, and legs without a plan get one (start_steps.cpp).
void start_steps(FleetState& fleet, Time now);
void start_step(FleetState& fleet, JobOrder& order, VehicleRun& run, Time now);
/// Vehicles without an order whose battery is low go to chargers (charging.cpp).
void charge_low(FleetState& fleet, Time now);
/// Orders of vehicles that were taken out wait for others (integration.cpp).
void release_withdrawn(FleetState& fleet, Time now);
/// Idle vehicles leave where they may not stay, and floor that others wait for (park_idle.cpp).
void park_idle(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
