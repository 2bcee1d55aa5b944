#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// Everything that is told: events with gapless numbers, and the states of orders.
namespace pulseline::fleet {

/// Appends to the gapless event sequence.
void add_event(FleetState& fleet, Time now, std::string type, JobOrderId order, LegId leg,
               const plant::VehicleId& vehicle, const std::string& actor, Params params = {});

/// Moves an order along the ISA-95 machine, with its event. `reason` empty code: none.
void set_order_state(FleetState& fleet, JobOrder& order, JobState to, Reason reason,
                     const std::string& actor, Time now);
/// Says why an order waits; an event and a row only when the reason's code or vehicle changed.
void set_order_reason(FleetState& fleet, JobOrder& order, Reason reason, Time now);

}  // namespace pulseline::fleet
