#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/id.hpp"
#include "core/base/result.hpp"
#include "core/fleet/state/job_control.hpp"
#include "core/fleet/state/job_order.hpp"
#include "core/fleet/state/leg_plan.hpp"
#include "core/fleet/state/new_order.hpp"
#include "core/fleet/state/ports.hpp"
#include "core/fleet/state/standing_orders.hpp"
#include "core/fleet/state/views.hpp"
#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::fleet {

struct OrderPreviewTask;  // order_preview.hpp
struct MotionQuestion;    // motion_preview.hpp
struct MotionTask;
class StationNews;
struct FleetState;  // state/fleet_state.hpp, for the rooms of core/fleet only
namespace journal {
class Recorder;
}

/// The fleet's state as its own methods see it: to be read, unless an input is being taken.
class GuardedState {
public:
    explicit GuardedState(std::unique_ptr<FleetState> state);
    ~GuardedState();
    const FleetState& operator*() const { return *state_; }
    const FleetState* operator->() const { return state_.get(); }
    FleetState& for_input() { return *state_; }  // Fleet::input only

private:
    std::unique_ptr<FleetState> state_;
};

/// The fleet core: one deterministic state machine. Commands and vehicle messages go in with the
/// time they came at; records, messages and views come out through take_outputs().
/// No clock, thread, socket, random source or database inside.
/// Whoever calls something that is not const gives an input: it is written to the journal before
/// anything changes, and the journal's calls made again give the same state and the same outputs.
/// Thread safety: none, one thread owns it. `plant` must outlive it and not change.
class Fleet {
public:
    /// `tables`: those of an earlier fleet of the same plant; none: they are worked out.
    Fleet(const plant::Plant& plant, StoredFleet stored, std::uint64_t id_seed, Time now,
          std::shared_ptr<const PlantTables> tables = nullptr);
    ~Fleet();
    /// One as a snapshot says (journal/snapshot.hpp). Errors: journal_broken {why}.
    static Result<std::unique_ptr<Fleet>> from_snapshot(
        const plant::Plant& plant, std::string_view bytes,
        std::shared_ptr<const PlantTables> tables = nullptr);
    /// The whole state. REQUIRES: what was put out has been taken.
    std::string snapshot() const;
    /// From now on every input goes there too; null: nowhere.
    void journal_into(journal::Recorder* recorder) { recorder_ = recorder; }

    // Commands of people and programs. An error changed nothing.
    Result<Created> create(const NewOrder& order, Time now);
    Result<JobOrder> pause_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                 const std::string& actor, Time now);
    Result<JobOrder> resume_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                  const std::string& actor, Time now);
    Result<JobOrder> cancel_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                  const std::string& actor, Time now);
    /// Any method of the Job Control machine; what its table does not allow is a conflict.
    Result<Created> control_order(JobOrderId id, const ControlRequest& request, Time now);
    /// The answer stored with an Idempotency-Key, if there is one.
    Result<std::optional<JobOrder>> earlier_answer(const std::string& client,
                                                   const std::string& key,
                                                   const std::string& body_sha256) const;

    // Templates and schedules. Storing the same once more gives the stored one.
    Result<OrderTemplate> store_template(const OrderTemplate& wanted, Time now);
    Status delete_template(const std::string& name, const std::string& actor, Time now);
    Result<Schedule> create_schedule(const NewSchedule& wanted, Time now);
    Result<Schedule> pause_schedule(ScheduleId id, bool paused,
                                    std::optional<std::int64_t> if_revision,
                                    const std::string& actor, Time now);
    Status delete_schedule(ScheduleId id, std::optional<std::int64_t> if_revision,
                           const std::string& actor, Time now);

    Result<VehicleView> pause_vehicle(const plant::VehicleId& id, const std::string& actor,
                                      Time now);
    /// Takes a vehicle out or in. Below `respect` it holds no floor: `off_floor` confirms that it
    /// is out of the hall. Its order is given to another where that is possible. Errors:
    /// unknown_vehicle, off_floor_unconfirmed, vehicle_busy.
    Result<VehicleView> integrate(const plant::VehicleId& id, Integration level, bool off_floor,
                                  const std::string& actor, Time now);
    /// A person says where it stands. Errors: unknown_vehicle, vehicle_busy, outside_hall, and why
    /// it does not hear.
    Result<VehicleView> init_position(const plant::VehicleId& id, const StatedPose& stated,
                                      const std::string& actor, Time now);
    /// Moves brackets or parking feet outside an order. Errors: unknown_vehicle, why it does not
    /// hear, and those of may_move_lifts (vehicle/lifts.hpp).
    Result<VehicleView> move_lifts(const plant::VehicleId& id, const StepAction& wanted,
                                   const std::string& actor, Time now);
    /// Whatever of them moves stays where it is, as part of an order, too. Errors: unknown_vehicle,
    /// unknown_lift, why it does not hear.
    Result<VehicleView> stop_lifts(const plant::VehicleId& id, const std::string& actor, Time now);
    /// A person says where a load is, or that it has left the plant. The vehicles concerned stand
    /// without an order. Errors: unknown_load, unknown_vehicle, unknown_station, and why not, each
    /// with its remedy (vehicle/loads.hpp, floor/carrying.hpp).
    Result<KnownLoad> place_load(const plant::LoadId& id, const LoadPlace& where,
                                 const std::string& actor, Time now);
    /// A new load, not in the plant yet, or what is known by now of one that is there. Errors:
    /// load_retired {load}, faults of the sheet (plant::validate_load), load_name_taken {name,
    /// load}, too_many_loads {most}, why nobody may carry it (plant::nobody_can_carry), or the
    /// vehicle below it may not any more, vehicle_busy, load_in_transfer {load, vehicle}.
    Result<KnownLoad> put_load(const plant::Load& known, const std::string& actor, Time now);
    /// It has left for ever; its id is never given again. Errors: unknown_load, load_in_plant,
    /// load_in_order {load, order}: an open one will take it over.
    Status retire_load(const plant::LoadId& id, const std::string& actor, Time now);
    void pause_fleet(const std::string& actor, Time now);
    Status resume_fleet(const std::vector<plant::VehicleId>& vehicles, const std::string& actor,
                        Time now);

    // What vehicles do.
    void vehicle_connected(const plant::VehicleId& id, Time now);
    void vehicle_disconnected(const plant::VehicleId& id, Time now);
    /// Any frame or pong; silence is counted from the last one.
    void vehicle_heard(const plant::VehicleId& id, Time now);
    void vehicle_state(const plant::VehicleId& id, const vda5050::StateMessage& state, Time now);
    void vehicle_factsheet(const plant::VehicleId& id, const vda5050::Factsheet& factsheet,
                           Time now);
    /// A message that was no valid VDA 5050: told as an event, changes nothing else.
    void vehicle_message_refused(const plant::VehicleId& id, const vda5050::VehicleError& error,
                                 Time now);
    /// Three takeovers of one identity within 60 s: refused until a person resumes the vehicle.
    void vehicle_identity_conflict(const plant::VehicleId& id, Time now);
    bool connection_refused(const plant::VehicleId& id) const;

    /// Floor that nobody is granted until it is reopened; who stands there may leave.
    /// Errors: nothing_to_close, unknown_hall, unknown_edge, bad_outline, too_many_closures.
    Result<Closure> close_floor(const NewClosure& wanted, const std::string& actor, Time now);
    Status reopen_floor(ClosureId id, const std::string& actor, Time now);

    /// The store refused what came before; the fleet was built anew from it and serves reads until
    /// the records it now puts out are stored.
    void store_failed(const StoreFault& fault, Time now);
    void store_works_again(Time now);

    /// Stored after their callers had been told that nobody knows: these vehicles, orders and their
    /// vehicles stand until a person asks again.
    void commands_expired(const std::vector<plant::VehicleId>& vehicles,
                          const std::vector<JobOrderId>& orders, Time now);

    /// Nobody listened between `since` and now: the process, or its thread of sockets, stood still.
    /// That time is no vehicle's silence, and nothing is released to one before its next state.
    void server_stood_still(Time since, Time now);

    /// The machine's clock and the server's differ by so much, or again, or no more. Nothing else
    /// changes: the core goes by the time that comes with its inputs.
    void clock_differs(Duration ahead, Time now);
    void clock_agrees(Time now);

    /// The answer to a question of Outputs::plans_wanted.
    void leg_planned(const plant::VehicleId& id, std::int64_t question, const LegPlanAnswer& answer,
                     Time now);

    /// Silence limits, resends, dispatch. Call at least every 100 ms.
    void tick(Time now);

    /// Everything put out since the last call.
    Outputs take_outputs(Time now);
    /// The views cost more than all the rest: who shows them to nobody leaves them out.
    void leave_out_views() { with_views_ = false; }

    std::shared_ptr<const PlantTables> tables() const;

    // Views.
    Preview preview(const NewOrder& order, Time now) const;
    /// What OrderPreviewer needs of the fleet to give the same. `self`: the order that is to be
    /// updated, which is no part of what it is planned in; empty: a new one.
    OrderPreviewTask preview_task(const NewOrder& order, Time now, JobOrderId self = {}) const;
    /// What MotionPreviewer needs of the fleet. Errors: unknown_vehicle, unknown_station,
    /// unknown_hall, other_hall, pose_unknown, outside_hall.
    Result<MotionTask> motion_task(const MotionQuestion& question) const;
    std::optional<JobOrder> order(JobOrderId id) const;
    std::vector<JobOrder> orders() const;  // open ones and recent final ones, newest first
    std::optional<OrderTemplate> order_template(const std::string& name) const;
    std::vector<OrderTemplate> order_templates() const;  // by name
    std::optional<Schedule> schedule(ScheduleId id) const;
    std::vector<Schedule> schedules() const;  // oldest first
    /// `with_leg`: also the outlines of its floor, which cost most.
    std::optional<VehicleView> vehicle(const plant::VehicleId& id, Time now,
                                       bool with_leg = true) const;
    std::vector<VehicleView> vehicles(Time now) const;
    std::vector<KnownLoad> loads() const;  // by id, without retired ones
    std::optional<KnownLoad> load(const plant::LoadId& id) const;
    std::vector<StationView> stations() const;
    std::optional<StationView> station(int number) const;
    FleetView view(Time now) const;
    std::int64_t last_event_seq() const;
    /// Who waits for whom on the floor, and what is closed.
    TrafficView traffic(Time now) const;
    /// What is closed, as planning takes it.
    std::vector<planning::ClosedFloor> closed_floors() const;

private:
    explicit Fleet(std::unique_ptr<FleetState> state);
    /// The one way to a state that may be changed: the journal takes the call, with all of its
    /// arguments, first. Defined in journal/recorder.hpp.
    template <auto Method, class... Args>
    FleetState& input(Time now, const Args&... arguments);

    GuardedState state_;
    journal::Recorder* recorder_ = nullptr;
    bool with_views_ = true;
    std::unique_ptr<StationNews> station_news_;
};

}  // namespace pulseline::fleet
