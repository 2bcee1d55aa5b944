#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/fleet/state/floor_state.hpp"
#include "core/fleet/state/leg_delivery.hpp"
#include "core/fleet/state/leg_plan.hpp"
#include "core/fleet/state/order_book.hpp"
#include "core/fleet/state/ports.hpp"
#include "core/fleet/state/standing_orders.hpp"
#include "core/fleet/state/views.hpp"
#include "core/fleet/tables/plant_tables.hpp"
#include "core/planning/legs/leg_planner.hpp"

/// The fleet's own state: structs only, what is done with them is in the other rooms. Not for use
/// outside core/fleet.
namespace pulseline::fleet {

/// An instant action on its way: sent again until the vehicle reports it final.
struct PendingAction {
    vda5050::Action action;
    Time first_sent;
    std::optional<Time> last_sent;
    int sends = 0;
    bool escalated = false;
};

/// The newest plan of a leg for a vehicle: an order is planned when it comes and starts at once, or
/// is tried again and again from the same place.
struct PlannedLeg {
    planning::LegRequest request;
    planning::LegPlan plan;
};

/// Floor of a move that is not of the class's roads; costs a sweep, and is asked for at every try.
struct SweptSegment {
    kinematics::Segment segment;
    std::optional<plant::Corridor> corridor;
    bool loaded = false;
    std::string hall;
    traffic::TileSet tiles;
};

/// One vehicle while the server runs. `record` is what survives a restart.
struct LiveVehicle {
    const plant::Vehicle* vehicle = nullptr;
    const plant::VehicleType* type = nullptr;
    VehicleRecord record;

    bool connected = false;
    bool reconciled =
        false;  // a state has come since it connected; before that no command goes out
    bool connection_refused = false;
    Link link = Link::kNever;
    std::optional<Time> last_heard;
    vda5050::StateMessage state;
    std::optional<Time> state_at;
    std::int64_t newest_header = 0;  // of the states on this connection; 0: none yet
    std::optional<vda5050::Factsheet> factsheet;

    LegDelivery delivery;
    FloorStand floor;
    /// Where it was believed to be, newest and at least a second before: see handle_pose.
    struct Seen {
        Pose2 pose;
        Time at;
        bool moving = false;   // about then
        double speed_mps = 0;  // by its own word
    };
    std::optional<Seen> seen;
    std::optional<Seen> seen_before;
    struct Statement {
        Whereabouts where;
        Time at;
        std::string actor;
    };
    std::optional<Statement> stated;    // by a person; none once the vehicle has said the same
    std::optional<Time> claim_told;     // newest report that can follow the claim of its record
    bool claim_left = false;            // the newest report cannot
    std::optional<Time> foreign_since;  // it has shown an order that is not this server's
    std::vector<PendingAction> actions;
    Time errors_from;                   // of the minute in which its errors are counted
    int errors_told = 0;                // as events, in that minute
    std::optional<Reason> charge_wait;  // why it should charge and does not
    std::optional<Time> charge_retry;
    /// When it went aside for others, the last three times: one that does so again and again gets
    /// nowhere.
    std::vector<Time> made_way;
    std::optional<LiftMove> lift;  // the newest; a restart of the server forgets it, as it ends it
    /// With what it holds floor: what it carries, or is about to take over. Follows from the loads.
    const plant::Load* load = nullptr;

    /// Outlines of the floor of the leg; they cost some milliseconds and change only with the base.
    struct Areas {
        LegId leg;
        std::size_t passed = 0;
        std::size_t released = 0;
        std::vector<geometry::Polygon> granted;
        std::vector<geometry::Polygon> horizon;
    };
    mutable Areas areas;
    /// By which codes it finds its way on the leg, worked out again when it is not there.
    struct LegMarkers {
        LegId leg;
        std::optional<Result<planning::LegChain>> chain;
    };
    mutable std::optional<LegMarkers> leg_markers;
    std::optional<AwaitedPlan> awaited_plan;  // of its next leg
    // Worked out again when they are not there.
    std::optional<PlannedLeg> newest_plan;
    mutable std::vector<SweptSegment> swept;

    bool has_leg() const { return record.has_leg; }
    Leg& leg() { return record.leg_data; }
    const Leg& leg() const { return record.leg_data; }
};

struct FleetState {
    FleetState(const plant::Plant& p, std::shared_ptr<const PlantTables> of_plant,
               std::uint64_t id_seed, Time now)
        : plant(p),
          tables(std::move(of_plant)),
          planner(tables->planner.again()),
          ids(id_seed),
          started(now),
          floor(tables->classes),
          questions(static_cast<std::int64_t>(id_seed % (1U << 31)) << 32) {}

    const plant::Plant& plant;
    std::shared_ptr<const PlantTables> tables;
    planning::LegPlanner planner;
    IdSource ids;
    Time started;
    std::map<plant::VehicleId, LiveVehicle> vehicles;
    std::map<plant::LoadId, LoadSheet> load_sheets;  // the plant's and those said since
    std::map<plant::LoadId, LoadRecord> loads;       // of all sheets but retired ones
    OrderBook orders;
    std::map<std::pair<std::string, std::string>, IdempotencyRecord> idempotency;
    Floor floor;
    struct ClosedFloor {
        Closure closure;
        traffic::TileSet tiles;
        traffic::ClosureIndex in_traffic = 0;
    };
    std::vector<ClosedFloor> closures;
    Time keys_swept;  // when old idempotency keys were last forgotten
    std::int64_t event_seq = 0;
    std::int64_t order_number = 0;
    // Number of the newest LegPlanQuestion; another fleet's answers, with floor that is closed
    // here, may still be on their way.
    std::int64_t questions;
    StandingOrders standing;
    std::int64_t stored_seq = 0;  // newest event of the store at start
    std::optional<StoreFault> store_fault;
    std::optional<ClockDifference> clock_difference;

    // Put out by this step.
    Outputs out;
    std::set<plant::VehicleId> stored_vehicles;  // records to write
    std::set<JobOrderId> stored_orders;
    std::set<plant::LoadId> stored_loads;
    std::set<plant::LoadId> stored_load_sheets;
    std::set<plant::VehicleId> changed_vehicles;  // views to show
    std::set<plant::StationId> changed_stations;  // by what came or went without a vehicle
    std::set<plant::VehicleId> plans_wanted;

    LiveVehicle* find(const plant::VehicleId& id) {
        const auto it = vehicles.find(id);
        return it == vehicles.end() ? nullptr : &it->second;
    }
    const LiveVehicle* find(const plant::VehicleId& id) const {
        return const_cast<FleetState*>(this)->find(id);
    }
    JobOrder* find(JobOrderId id) { return orders.find(id); }
    const JobOrder* find(JobOrderId id) const { return orders.find(id); }

    void store(JobOrder& order) {
        ++order.revision;
        stored_orders.insert(order.id);
    }
    void store(const LiveVehicle& live) {
        stored_vehicles.insert(live.record.id);
        changed_vehicles.insert(live.record.id);
    }
};

}  // namespace pulseline::fleet
