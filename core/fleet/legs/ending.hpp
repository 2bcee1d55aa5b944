#pragma once

#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// How legs end, and what becomes of their orders.
namespace pulseline::fleet {

/// Each way in which a leg is over.
enum class LegEnd {
    kDone,             // the vehicle has done all of it
    kAnotherApproach,  // it stands and was not measured good enough; the caller says what follows
    kCancelled,        // it has given the leg up and stands: the step begins anew
    kLost,             // it does not have the leg any more: the step begins anew
    kRejected,         // it did not take the leg: a person decides
    kUnsent,           // nothing of it was sent, and its plan leads nowhere: the step begins anew
    kOffFloor,         // it is taken out of the hall: a person decides
};

/// Forgets the leg; the vehicle keeps the floor it stands on, and once it is done with it none of
/// the rest. A lost leg is kept until the vehicle knows its pose: it may stand anywhere on the
/// base, which only the leg remembers over a restart. An order that was asked to be cancelled is
/// given up.
void end_leg(FleetState& fleet, LiveVehicle& live, LegEnd end, Time now);
/// Ends an order whose vehicle has nothing to do for it any more: Ended after a Stop, else Aborted.
void abort_order(FleetState& fleet, JobOrder& order, Reason reason, const std::string& actor,
                 Time now);
/// The running order of a vehicle that is taken out waits for a person.
void interrupt(FleetState& fleet, const LiveVehicle& live, const std::string& actor, Time now);

}  // namespace pulseline::fleet
