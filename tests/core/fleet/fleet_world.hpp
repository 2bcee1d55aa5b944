#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/fleet/fleet.hpp"
#include "core/fleet/legs/leg_plan_answerer.hpp"
#include "core/plant/plant.hpp"

/// A hall, obedient vehicles and a store in memory, so that tests can crash the fleet at any
/// record.
namespace pulseline::fleet::testing {

/// 60 x 40 m hall; stations 1..4 on a line 12 m apart facing east, each with two codes; vehicles
/// "V1" and "V2" (3 x 1.2 m, linear, fixed axis and self rotation) at home on stations 1 and 4.
plant::Plant small_plant();

/// Applies committed records, as the database does.
class MemoryStore {
public:
    void commit(const Records& records);
    StoredFleet load() const;

    std::map<JobOrderId, JobOrder> orders;
    std::map<plant::VehicleId, VehicleRecord> vehicles;
    std::map<plant::LoadId, LoadRecord> loads;
    std::map<plant::LoadId, LoadSheet> load_sheets;
    std::vector<std::pair<plant::LoadId, LoadMove>> load_moves;
    std::vector<StopRecord> stops;
    std::vector<Event> events;
    std::vector<IdempotencyRecord> idempotency;
    std::vector<Closure> closures;
    std::map<ScheduleId, Schedule> schedules;
    std::map<std::string, OrderTemplate> templates;
};

/// Obeys VDA 5050: drives released nodes one by one, measures stops, answers instant actions.
class FakeVehicle {
public:
    FakeVehicle(const plant::Plant& plant, plant::VehicleId id, Pose2 pose);

    void receive(const VehicleMessage& message);
    /// One more released node, one action or one standstill; true when something changed.
    bool step();
    /// What moves outside an order ends; `why`: it has failed so.
    void end_lifts(const std::string& why = {});
    /// Power cycle: forgets order and pose.
    void restart();
    /// What it was told. REQUIRES: it has an order.
    const vda5050::OrderMessage& order() const { return *order_; }

    vda5050::StateMessage state;
    Pose2 stop_error;                    // added to the next measured stops
    std::optional<Pose2> arrival_error;  // with it it tells where its drive had ended
    bool pose_follows_stop = true;       // else its own pose stays what it was
    std::optional<std::string> measure_fails;
    std::string action_fails;                           // type of the action that fails
    std::vector<std::string> actions_done;              // types in the order in which they finished
    std::function<void(const std::string&)> on_action;  // of such a type has finished
    bool lifts_end = true;   // what is moved outside an order comes to its end at once
    bool stands = false;     // does not move, whatever it is told
    bool sees_codes = true;  // reports the codes below its cameras while standing on them
    std::vector<plant::Transmitter> transmitters;  // of the newest setTransmitters
    std::vector<plant::Reflector> reflectors;      // of the newest setReflectors
    int orders_received = 0;
    int node_steps = 0;

private:
    void see_codes();
    void tell_what_is_left();

    const plant::Plant& plant_;
    plant::VehicleId id_;
    std::optional<vda5050::OrderMessage> order_;
    std::size_t at_ = 0;
};

/// Fleet + vehicles + store on one virtual clock.
class World {
public:
    World();
    explicit World(plant::Plant plant);

    /// Lets `seconds` pass in ticks of 0.1 s; vehicles take one step per tick.
    void run(double seconds);
    /// Commits what the fleet put out and delivers its messages.
    void settle();
    /// Server dies without warning before anything uncommitted left it, and starts again.
    void crash_server();
    void connect_all();
    /// All vehicles say in their factsheets that they do these, at nodes and outside an order.
    void announce(std::vector<std::string> actions);

    FakeVehicle& vehicle(const std::string& id) { return vehicles.at(plant::VehicleId(id)); }
    Result<Created> order(const std::string& vehicle, std::vector<int> stations,
                          plant::MotionMode mode = plant::MotionMode::kAuto);
    Result<Created> order(NewOrder request);
    JobOrder only_order() const;
    /// Stations whose occupant or reservation is another than a dashboard was told that has looked
    /// since the start, by their numbers.
    std::vector<int> stations_told_wrong() const;
    const JobOrder& stored(JobOrderId id) const { return store.orders.at(id); }
    int count_events(const std::string& type) const;

    plant::Plant plant;
    MemoryStore store;
    Time now = time_from_ns(1'800'000'000'000'000'000);
    std::unique_ptr<Fleet> fleet;
    std::map<plant::VehicleId, FakeVehicle> vehicles;
    std::map<plant::VehicleId, bool> connected;
    bool vehicles_move = true;
    bool plans_at_once = true;  // else what the fleet asks gathers in `questions`
    std::vector<LegPlanQuestion> questions;
    LegPlanAnswerer answerer;
    std::map<plant::StationId, StationView> told;  // of the stations; those not told of are free
    int ticks = 0;
    std::uint64_t seed = 1;
};

}  // namespace pulseline::fleet::testing
