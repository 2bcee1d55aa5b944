#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// What an order's own fields say about when it may start and with which vehicle. Dispatch asks
/// both for every waiting order; nothing here looks at whether a vehicle is ready.
namespace pulseline::fleet {

/// Why an order that is allowed to start has to wait, whatever vehicle were free: earliest_start,
/// dependency_open, dependency_aborted, sequence_earlier, sequence_vehicle_busy, vehicle_kept,
/// actions_not_announced. Nothing: it may start now.
std::optional<Reason> waits_for_condition(const FleetState& fleet, const JobOrder& order, Time now);

/// Whether the vehicle is one that the order may have: the required one, of the required type, of
/// its sequence, kept by no other sequence, and able to do its actions.
bool vehicle_fits(const FleetState& fleet, const JobOrder& order, const LiveVehicle& live);

/// The first action of the order that the vehicle's factsheet does not announce for nodes; null:
/// none. A vehicle without a factsheet announces nothing.
const StepAction* unannounced_action(const JobOrder& order, const LiveVehicle& live);
bool announces_at_node(const LiveVehicle& live, const StepAction& action);

/// Notes in waiting orders what became of the orders they depend on.
void settle_dependencies(FleetState& fleet);
/// Whether `order` cannot end before `on` has: by dependencies and places in a sequence. With
/// `changed`, as if that stood in the place of the order of its id.
bool depends_on(const FleetState& fleet, const JobOrder& order, JobOrderId on,
                const JobOrder* changed = nullptr);

}  // namespace pulseline::fleet
