#pragma once

/// Planted bugs, so that the simulation judge can prove that it finds them. In the product
/// `mutated` is a constant false and costs nothing; only the target core_traffic_mutated is built
/// with PULSELINE_MUTATIONS.
namespace pulseline::traffic {

enum class Mutation {
    kNone,
    kTailFreedTooEarly,      // tiles freed one move before the tail has left them
    kGrantNotAtomic,         // one tile of a move is checked, all are taken
    kCycleTestSkipped,       // a merge is kept although the graph has a cycle
    kOrderIgnored,           // the horizon is released as soon as the floor is empty
    kBreakdownForgetsTiles,  // a halted vehicle's floor is given away
    kClosureIgnored,         // closed floor is granted
    kReopenForgetsOverlap,   // reopening one area opens what another one closes too
    kRebuildLosesBase,       // after a restart the granted floor is free
    kRebuildLosesOrder,      // after a restart the order over a tile is another one
    kRebuildLosesClosure,    // after a restart the closed area is open
    kRestNotHeld,            // a vehicle that has arrived for good gives its floor back
    kSweptWithoutTail,       // a move's tiles lack those it starts on
    kReplanChangesBase,      // a new plan withdraws floor already granted
    kPassedCountsTwice,      // a doubled report counts again
    kRelocationNotHeld,      // a vehicle found elsewhere does not hold the floor there
    kHaltedIsReleased,       // a halted vehicle gets more floor
    kRollbackIncomplete,     // a refused merge leaves its traces in the queues
    kSuccessorsForgotten,    // those behind a new plan keep their old predecessors
    kVisitLost,              // a replanned task leaves out a stop
    kRestCrossed,            // a resting place that somebody still has to cross is accepted
};
constexpr int kMutationCount = 21;

#ifdef PULSELINE_MUTATIONS
inline Mutation planted_mutation = Mutation::kNone;
inline bool mutated(Mutation mutation) { return planted_mutation == mutation; }
#else
constexpr bool mutated(Mutation) { return false; }
#endif

}  // namespace pulseline::traffic
