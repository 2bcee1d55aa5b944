#pragma once

/// Planted bugs of the fleet, as traffic/mutation.hpp has them of traffic: the simulation judge has
/// to find each. Only the target core_fleet_mutated is built with PULSELINE_FLEET_MUTATIONS.
namespace pulseline::fleet {

enum class Mutation {
    kNone,
    kRepeatMakesAnother,     // the same Idempotency-Key makes a second order
    kKeyNotStored,           // a key is forgotten by a restart
    kRestartNeedsNobody,     // orders go on by themselves after a restart
    kPauseNotKept,           // a vehicle paused by a person gets further floor
    kManualIsDriven,         // a vehicle in manual mode or with a fatal error gets floor
    kSafetyStopIgnored,      // one with its safety stop pulled gets floor
    kSilentIsExtended,       // a silent vehicle gets floor
    kBaseNotStored,          // a base is sent that the store does not know
    kProgressNotStored,      // a restart forgets what a running order has done
    kCancelNotAwaited,       // the floor is free before the vehicle has confirmed
    kCancelFailedIsDone,     // a cancelOrder that found no order is the end of it
    kFailedStopWhileMoving,  // a stop that a cancel failed is taken while the vehicle brakes
    kOvertakenStateTaken,    // a report that was overtaken counts
    kWayOrderForgotten,      // a leg is forgotten while its order is on its way
    kReroutedLosesStop,      // another way to the goal has no stop
    kMakesWayElsewhere,      // a vehicle that makes way ends where it was first sent
    kTypeIgnored,            // an order goes to a vehicle of another type
    kBusyIsFree,             // a vehicle with an order gets another
    kLastStepSkipped,        // an order ends one step too early
    kLostPoseLosesFloor,     // a vehicle without pose holds no floor after a restart
    kTurnsOnly,              // one that cannot turn does not try to leave straight on
    kJumpIsBelieved,         // a pose that cannot be true counts
    kFarStopIsTaken,         // a stop measured far from its station counts
};
constexpr int kMutationCount = 24;

#ifdef PULSELINE_FLEET_MUTATIONS
inline Mutation planted_mutation = Mutation::kNone;
inline bool mutated(Mutation mutation) { return planted_mutation == mutation; }
#else
constexpr bool mutated(Mutation) { return false; }
#endif

}  // namespace pulseline::fleet
