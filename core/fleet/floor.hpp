#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/fleet/floor_graph.hpp"
#include "core/fleet/job_order.hpp"
#include "core/traffic/monitor.hpp"
#include "core/traffic/traffic.hpp"

/// The floor that the fleet's vehicles share: its joint plan (core/traffic) and how a leg, which is
/// nodes and edges for a vehicle, stands in it as moves. Not for use outside core/fleet.
namespace pulseline::fleet {

struct FleetState;
struct VehicleRun;

/// What the fleet keeps of a vehicle about the floor; nothing of it is stored, all is rebuilt.
struct FloorStand {
    std::size_t of_class = 0;
    traffic::VehicleIndex vehicle = 0;
    /// Node k of the leg is reached when this many + k moves are passed.
    std::int64_t moves_before_leg = 0;
    bool leg_planned = false;           // the leg's moves are in the joint plan
    std::optional<Pose2> pose;          // where it was settled last; none: it holds no floor yet
    std::optional<Reason> conflict;     // it stands on another's floor
    std::optional<Time> next_try;       // of an admission that failed
    std::optional<Time> in_vain_since;  // its order has had no way since
    std::optional<Time> next_leave;     // of an idle vehicle that found no way to leave
    std::optional<Time> idle_since;
};

struct Floor {
    explicit Floor(const std::vector<FloorClass>& of_plant) : classes(of_plant) {}

    traffic::Traffic traffic{true};  // reports its changes to the monitor
    traffic::Monitor monitor;
    const std::vector<FloorClass>& classes;  // of the plant's tables
    /// Set on the first violation that the monitor finds: nothing is granted any more.
    std::optional<Reason> stopped;
    std::optional<Time> improved;
    std::optional<Time> checked;
};

/// Says of which class of the plant's tables each vehicle is.
void find_classes(FleetState& fleet);
/// Puts every vehicle on the floor its record says, base included.
void open_floor(FleetState& fleet, Time now);

/// Floor under the vehicle's outline at a pose, position error included.
traffic::TileSet floor_under(const FleetState& fleet, const VehicleRun& run, const Pose2& pose);
/// Floor of an edge of the vehicle's leg: what it sweeps there, and the edge's corridor.
traffic::TileSet floor_of_edge(const FleetState& fleet, const VehicleRun& run,
                               const OrderEdge& edge);
/// Floor in which the vehicle stands when it stops at node `i` of its leg.
traffic::TileSet floor_at_node(const FleetState& fleet, const VehicleRun& run, std::size_t i);
/// Says of each node behind the leg's base how far beside it the vehicle may pass.
void widen_nodes(Leg& leg);

/// A vehicle without a leg stands where its record says. It keeps its plan when that is where the
/// plan has it, unless `give_up_plan`.
void settle(FleetState& fleet, VehicleRun& run, Time now, bool give_up_plan = false);
/// Nobody knows where it stands: it keeps all its floor, and of that where it says that it stands
/// what is free.
void hold_both_floors(FleetState& fleet, VehicleRun& run, Time now);
/// Somebody has told where it stands, or has known; else it is only presumed to stand at home.
bool has_stood(const VehicleRecord& record);
/// The vehicle is out of the hall: it holds no floor.
void leave_floor(FleetState& fleet, VehicleRun& run, Time now);
/// The last approach was not successful enough to move on: floor for a correction in place.
void hold_for_correction(FleetState& fleet, VehicleRun& run, const Pose2& target, Time now);

/// Takes the rest of the run's leg (all behind its base) into the joint plan. Nothing is changed
/// when there is no plan: the reason says who or what is in the way. The leg's horizon may come out
/// different: another way, when its own is blocked for good.
std::optional<Reason> plan_on_floor(FleetState& fleet, VehicleRun& run, Time now);
/// The leg ends here with the stop; a plan that gives way first ends elsewhere.
bool stands_at_stop(const FleetState& fleet, const VehicleRun& run);
/// The leg ended beside all places without its stop, so no plan leads on from there.
bool is_dead_end(const FleetState& fleet, const VehicleRun& run);
/// REQUIRES: the leg has no plan. At the end of its base, and who bars the rest has no plan to
/// leave (maybe because of this one), or has made it make way: it goes elsewhere only without its
/// leg.
bool is_stuck(const FleetState& fleet, const VehicleRun& run);
/// The rest of the vehicle's plan is the graph's alone.
bool goes_by_places(const FleetState& fleet, const VehicleRun& run);
/// A leg of one node becomes the drive that the vehicle's plan already has.
void take_plan_as_leg(FleetState& fleet, VehicleRun& run);
/// Brings the legs of all vehicles with new plans up to date and tells those on the way.
void follow_replans(FleetState& fleet, Time now);
/// Grants moves so that nodes up to `wanted_node` are in the base, as far as traffic lets it;
/// returns the number of released nodes.
std::size_t grant_nodes(FleetState& fleet, VehicleRun& run, std::size_t wanted_node, Time now);
/// Nodes up to leg.passed_nodes are behind the vehicle.
void pass_nodes(FleetState& fleet, VehicleRun& run, Time now);
/// The stop of the leg is made.
void pass_stop(FleetState& fleet, VehicleRun& run, Time now);
/// It stands where it cannot rest with what it has brought, until others need the floor.
bool is_at_work(const FleetState& fleet, const VehicleRun& run);
/// The floor is needed: its way to a resting place comes next.
void end_work(FleetState& fleet, VehicleRun& run, Time now);
/// Whether it makes way for others where it stands.
traffic::Leaves leaves(const FleetState& fleet, const VehicleRun& run);
/// The task is given up where the vehicle stands without a leg.
void give_up_task(FleetState& fleet, VehicleRun& run, Time now);
/// Vehicles that cannot move hold their floor and are planned around.
void halt_those_that_cannot_move(FleetState& fleet, Time now);
void halt_or_resume(FleetState& fleet, VehicleRun& run, Time now);
/// Its order has no way at present and is tried again.
bool tries_in_vain(const FleetState& fleet, const VehicleRun& run);
/// Who waits tries other ways, about once a second.
void improve_floor(FleetState& fleet, Time now);

/// Why the vehicle's next move is not granted; none: it is, or there is none.
std::optional<Reason> floor_wait(const FleetState& fleet, const VehicleRun& run);
Reason floor_reason(const FleetState& fleet, const traffic::Block& block);

// --- the monitor's view (floor_watch.cpp) ---
/// Feeds the monitor; false: it found a violation, and nothing may be granted.
bool floor_is_sound(FleetState& fleet, Time now);
/// What the vehicle is about to be told, its leg up to `nodes`, held against the floor that the
/// monitor knows it to hold: leg and plan must not have come apart. False as above.
bool keeps_to_its_floor(FleetState& fleet, const VehicleRun& run, std::size_t nodes, Time now);
/// Everything anew, once a second when something has changed.
void check_whole_floor(FleetState& fleet, Time now);

}  // namespace pulseline::fleet
