#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/fleet/fleet.hpp"
#include "core/fleet/floor.hpp"
#include "core/fleet/leg_plans.hpp"
#include "core/fleet/order_book.hpp"
#include "core/fleet/plant_tables.hpp"
#include "core/planning/leg_planner.hpp"

/// The fleet's own state, shared by the phases of fleet.cpp. Not for use outside core/fleet.
namespace pulseline::fleet {

/// An instant action on its way: sent again until the vehicle reports it final.
struct PendingAction {
    Action action;
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
struct VehicleRun {
    const plant::Vehicle* vehicle = nullptr;
    const plant::VehicleType* type = nullptr;
    VehicleRecord record;

    bool connected = false;
    bool reconciled =
        false;  // a state has come since it connected; before that no command goes out
    bool connection_refused = false;
    Link link = Link::kNever;
    std::optional<Time> last_heard;
    StateMessage state;
    std::optional<Time> state_at;
    std::int64_t newest_header = 0;  // of the states on this connection; 0: none yet
    std::optional<Factsheet> factsheet;

    // The order message under way.
    bool leg_seen = false;            // the vehicle has shown this leg's id
    std::size_t update_from = 0;      // first node of the last update
    std::optional<Time> update_sent;  // until the vehicle shows its update id
    int update_sends = 0;
    std::optional<Time> order_sent;  // newest message of this leg on this connection
    bool gave_up = false;            // the vehicle does not have this leg; see forget_leg
    bool cancelling = false;         // cancelOrder is not final: nothing but instant actions
    FloorStand floor;
    /// Where it was believed to be, newest and at least a second before: see take_pose.
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
    std::optional<Statement> stated;  // by a person; none once the vehicle has said the same
    std::optional<Time> claim_told;   // newest report that can follow the claim of its record
    bool claim_left = false;          // the newest report cannot
    std::optional<Time> leg_started;
    std::optional<Time> foreign_since;  // it has shown an order that is not this server's
    std::vector<PendingAction> actions;
    Time errors_from;                   // of the minute in which its errors are counted
    int errors_told = 0;                // as events, in that minute
    std::optional<Reason> charge_wait;  // why it should charge and does not
    std::optional<Time> charge_retry;
    /// When it went aside for others, the last three times: one that does so again and again gets
    /// nowhere.
    std::vector<Time> made_way;

    /// Outlines of the floor of the leg; they cost some milliseconds and change only with the base.
    struct Areas {
        LegId leg;
        std::size_t passed = 0;
        std::size_t released = 0;
        std::vector<geometry::Polygon> granted;
        std::vector<geometry::Polygon> horizon;
    };
    mutable Areas areas;
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
    std::map<plant::VehicleId, VehicleRun> vehicles;
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
    std::set<plant::VehicleId> changed_vehicles;  // views to show
    std::set<plant::StationId> changed_stations;
    std::set<plant::VehicleId> plans_wanted;

    VehicleRun* find(const plant::VehicleId& id) {
        const auto it = vehicles.find(id);
        return it == vehicles.end() ? nullptr : &it->second;
    }
    const VehicleRun* find(const plant::VehicleId& id) const {
        return const_cast<FleetState*>(this)->find(id);
    }
    JobOrder* find(JobOrderId id) { return orders.find(id); }
    const JobOrder* find(JobOrderId id) const { return orders.find(id); }

    void store(JobOrder& order) {
        ++order.revision;
        stored_orders.insert(order.id);
    }
    void store(const VehicleRun& run) {
        stored_vehicles.insert(run.record.id);
        changed_vehicles.insert(run.record.id);
    }
};

/// Appends to the gapless event sequence.
void add_event(FleetState& fleet, Time now, std::string type, JobOrderId order, LegId leg,
               const plant::VehicleId& vehicle, const std::string& actor, Params params = {});

/// Moves an order along the ISA-95 machine, with its event. `reason` empty code: none.
void set_order_state(FleetState& fleet, JobOrder& order, JobState to, Reason reason,
                     const std::string& actor, Time now);
/// Says why an order waits; an event and a row only when the reason's code or vehicle changed.
void set_order_reason(FleetState& fleet, JobOrder& order, Reason reason, Time now);

Duration silence(const FleetState& fleet, const VehicleRun& run, Time now);
/// Vehicle's outline (with its load) at a pose, convex pieces in the hall frame.
std::vector<geometry::Polygon> outline_at(const VehicleRun& run, const Pose2& pose);
bool is_loaded(const VehicleRun& run);
/// Speed of the vehicle by its own factsheet over that of its type in the plant.
double speed_share(const VehicleRun& run);
std::string hall_of(const FleetState& fleet, const VehicleRun& run);
std::size_t hall_index(const FleetState& fleet, const std::string& hall);
/// Station whose theoretical pose the vehicle stands on (within 0.25 m and 3 deg); empty: none.
plant::StationId station_at(const FleetState& fleet, const VehicleRun& run, const Pose2& pose);
std::vector<planning::StandingBody> standing_bodies(const FleetState& fleet,
                                                    const plant::HallId& hall,
                                                    const plant::VehicleId& except);

// --- legs (legs.cpp) ---
planning::LegRequest leg_request(const FleetState& fleet, const VehicleRun& run, const Pose2& start,
                                 const plant::StationId& target, plant::MotionMode mode);
/// The drive as nodes and edges; nothing released but nodes[0].
Leg build_leg(const FleetState& fleet, const VehicleRun& run, const planning::LegPlan& plan,
              const plant::Station& station, const Pose2& start, LegId id);
/// Where a leg starts: the vehicle stands there, within what a measured stop may be off.
OrderNode start_node(const Pose2& pose, const std::string& hall);
/// A leg that only measures and corrects where the vehicle stands (second approach).
Leg build_adjust_leg(const FleetState& fleet, const VehicleRun& run, const plant::Station& station,
                     const Pose2& pose, LegId id);
/// What the vehicle does at the station node: correct the stop, then measure it.
std::vector<Action> stop_actions(const FleetState& fleet, const VehicleRun& run,
                                 const plant::Station& station, const LegId& leg);
/// What it does where it only rests: it takes away what odometry has gathered, and charges if the
/// leg is for that.
std::vector<Action> rest_actions(const FleetState& fleet, const VehicleRun& run,
                                 const plant::Station& station, const Leg& leg);
/// Releases as many further nodes as the vehicle needs to keep its speed and sends the update.
void extend_base(FleetState& fleet, VehicleRun& run, Time now);
void send_order_update(FleetState& fleet, VehicleRun& run, std::size_t from, Time now);
/// The vehicle gets this leg; nothing of it is sent yet.
void take_leg(VehicleRun& run, Leg leg);
/// As take_leg, and plans its way on the floor (a leg of one node needs none). Nothing is changed
/// when there is no way: the reason says who or what is in it.
std::optional<Reason> try_leg(FleetState& fleet, VehicleRun& run, Leg leg, Time now);
/// The first message of a leg just taken.
void send_leg(FleetState& fleet, VehicleRun& run, Time now);
/// Forgets the leg; the vehicle keeps the floor it stands on. `arrived`: and the rest of its plan.
void drop_leg(FleetState& fleet, VehicleRun& run, Time now, bool arrived = false);

// --- expected ends (expected_end.cpp) ---
/// From what is left of the leg and of the steps behind it.
void expect_end(FleetState& fleet, const VehicleRun& run, JobOrder& order, Time now);
/// Those whose time has come without their end.
void renew_expected_ends(FleetState& fleet, Time now);

// --- vehicle input (vehicle_input.cpp) ---
void connect(FleetState& fleet, VehicleRun& run, Time now);
void disconnect(FleetState& fleet, VehicleRun& run, Time now);
void hear(FleetState& fleet, VehicleRun& run, Time now);
/// The vehicle stops taking new floor until a person allows it; its order is interrupted.
void require_person(FleetState& fleet, VehicleRun& run, Reason reason, Time now);
/// Counts an error of the vehicle. False: it has told of so many in this minute that no more become
/// events.
bool may_tell_error(FleetState& fleet, VehicleRun& run, Time now);
/// Until a person lets it go on, no order and no update of one goes to it, new or again.
bool waits_for_person(const VehicleRun& run);
/// Asks the vehicle to give up its leg; the leg is dropped when it has confirmed and stands.
void cancel_leg(FleetState& fleet, VehicleRun& run, Time now);
/// Sends startPause or stopPause; the newest wish counts.
void pause_motion(FleetState& fleet, VehicleRun& run, const char* action_type, Time now);
/// The vehicle has not shown its leg and may have the message or still get it: the leg must not be
/// forgotten.
bool is_on_its_way(const VehicleRun& run);
/// False while a person drives it at the vehicle itself (VDA 5050 operatingMode).
bool is_automatic(const VehicleRun& run);
/// It has given up its order, or done all of it.
bool has_nothing_left(const StateMessage& state);
/// It carries out an order that this server has not given, or has forgotten.
bool has_foreign_order(const VehicleRun& run);
/// An instant action of the type has been sent, or waits to be, and the vehicle has not ended it.
bool is_asked(const VehicleRun& run, const char* action_type);
/// After a person's act; the vehicle is not ready until that order is gone.
void cancel_foreign_order(FleetState& fleet, VehicleRun& run, const std::string& actor, Time now);
/// The vehicle does not have its leg any more. Until it knows its pose it may stand anywhere on the
/// base, which only the leg remembers over a restart: so long the leg is kept.
void forget_leg(FleetState& fleet, VehicleRun& run, Time now);
void take_state(FleetState& fleet, VehicleRun& run, const StateMessage& state, Time now);
void send_action(FleetState& fleet, VehicleRun& run, Action action, Time now);
void update_links(FleetState& fleet, Time now);
void resend(FleetState& fleet, Time now);

// --- where vehicles stand (vehicle_pose.cpp) ---
/// Takes what `run.state` says of the pose, if it can be true after what was known (`before`).
/// Else, from then on and until a person has said where it stands, it counts as not known.
void take_pose(FleetState& fleet, VehicleRun& run, const StateMessage& before, Time now);
/// A vehicle that lost its pose and sees surveyed codes is told where it stands. Nothing moves by
/// it.
void offer_pose_from_codes(FleetState& fleet, VehicleRun& run, Time now);
bool is_in_doubt(const VehicleRun& run);
/// Having claimed to be elsewhere it says again that it is where it was known to be, or that it
/// has gone on from there on its leg. A claim that only happens to lie on the leg is not that.
bool stands_where_known(const FleetState& fleet, const VehicleRun& run, Time now);
/// A person has looked: it is where it says now.
void end_doubt(FleetState& fleet, VehicleRun& run, Time now);
/// After a restart: both floors, and the leg is given up as it was to be before.
void keep_doubt(FleetState& fleet, VehicleRun& run, Time now);
/// Halls can be told apart by name only.
bool is_in_hall(const FleetState& fleet, const Whereabouts& where);

// --- stops (stops.cpp) ---
void take_measured_stop(FleetState& fleet, VehicleRun& run, const StopMeasurement& told, Time now);
void take_failed_stop(FleetState& fleet, VehicleRun& run, const std::string& why, Time now);

// --- orders (orders.cpp) ---
/// The vehicle that would serve the order and the plan of each step from where it will stand.
struct OrderPlan {
    plant::VehicleId vehicle;
    std::vector<Pose2> starts;  // one per step
    /// Absent: the start is unknown or in place, or the leg is estimated.
    std::vector<std::optional<planning::LegPlan>> plans;
    std::vector<double> durations_s;  // 0: start unknown or in place
};
/// Free manoeuvres take too long to be planned on the fleet's own thread (leg_plans.hpp).
enum class FreeManoeuvres { kEstimated, kPlanned };
Result<OrderPlan> plan_order(const FleetState& fleet, const NewOrder& order, Time now,
                             FreeManoeuvres free = FreeManoeuvres::kEstimated);
/// As the crow flies, at top speed.
double least_drive_s(const VehicleRun& run, const Pose2& from, const plant::Station& to);
/// Whether the vehicle stands so near the station's pose that only the stop has to be corrected.
bool nearly_there(const VehicleRun& run, const Pose2& pose, const plant::Station& station);
Result<Created> create_order(FleetState& fleet, const NewOrder& order, Time now);
/// Gives an order that has not started all that `request` may set.
Status update_order(FleetState& fleet, JobOrder& order, const NewOrder& request,
                    const std::string& actor, Time now);
Result<std::optional<JobOrder>> earlier_answer(const FleetState& fleet, const std::string& client,
                                               const std::string& key,
                                               const std::string& body_sha256);
void keep_answer(FleetState& fleet, const IdempotencyRecord& record);
/// Ends an order whose vehicle has nothing to do for it any more: Ended after a Stop, else Aborted.
void abort_order(FleetState& fleet, JobOrder& order, Reason reason, const std::string& actor,
                 Time now);

// --- schedules (schedules.cpp) ---
void restore_standing(FleetState& fleet, StoredFleet& stored);
/// After a restart the vehicles that schedules may set in motion need a person's act, too.
void require_persons_for_schedules(FleetState& fleet, Time now);
void take_standing(FleetState& fleet, Records& records);
/// Makes the orders whose time has come.
void run_schedules(FleetState& fleet, Time now);

// --- dispatch (dispatch.cpp) ---
void dispatch(FleetState& fleet, Time now);
/// What a report of one vehicle can set in motion at once: its base, its next step. The rest waits
/// for the next tick, so that a report costs the same in a fleet of a thousand.
void dispatch_for(FleetState& fleet, VehicleRun& run, Time now);
/// Why this vehicle may not start a move now; nullopt: it may.
std::optional<Reason> not_ready(const FleetState& fleet, const VehicleRun& run, Time now);
/// The same for an order's next step: feet that are down do not bar what raises them.
std::optional<Reason> not_ready_for(const FleetState& fleet, const JobOrder& order,
                                    const VehicleRun& run, Time now);
/// Why it would not obey a release of floor, whatever its order; others are planned around it.
std::optional<Reason> cannot_move(const FleetState& fleet, const VehicleRun& run);

// --- charging (charging.cpp) ---
/// Whether it stays on its charger, whoever waits.
bool charges_on(const VehicleRun& run);
/// Why its battery bars it from new orders; none: it does not.
std::optional<Reason> battery_bar(const VehicleRun& run);
/// Before a drive: whether it has to be waited for that the vehicle stops charging.
bool ends_charging(FleetState& fleet, VehicleRun& run, Time now);
void charge_failed(FleetState& fleet, VehicleRun& run, const std::string& why, Time now);

// --- localisation from codes (code_pose.cpp) ---
std::optional<Pose2> pose_from_codes(const FleetState& fleet, const VehicleRun& run,
                                     const std::vector<CameraReading>& readings);

// --- restart (restore.cpp) ---
void take_vehicles_of_plant(FleetState& fleet);
/// Fills an empty fleet from plant and store. Open orders wait for a person's act.
void restore(FleetState& fleet, StoredFleet stored, Time now);
/// What was stored by a clock that was ahead of the truth: no time lies in the future any more.
/// Before restore_standing() and restore(); event_seq is set.
void bring_back_times(FleetState& fleet, StoredFleet& stored, Time now);

// --- views (views.cpp) ---
StationView station_view(const FleetState& fleet, const plant::Station& station);
/// All of them, with one look at every vehicle.
std::vector<StationView> station_views(const FleetState& fleet);
VehicleView view_of(const FleetState& fleet, const VehicleRun& run, Time now, bool with_leg = true);
std::vector<Check> start_checks(const FleetState& fleet, const VehicleRun& run,
                                const plant::Station* target,
                                const std::optional<planning::LegPlan>& plan, Time now);

}  // namespace pulseline::fleet
