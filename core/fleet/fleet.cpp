#include "core/fleet/fleet.hpp"

#include <algorithm>

#include "core/fleet/state.hpp"

namespace pulseline::fleet {
namespace {

// Final orders stay in memory for this long (idempotent repeats, lists); all of them are in the store.
constexpr Duration kKeepFinal = std::chrono::hours(24 * 7);

traffic::TileSet all_of(const std::vector<traffic::TileSet>& sets, std::size_t first) {
    traffic::TileSet all;
    for (std::size_t i = std::min(first, sets.size()); i < sets.size(); ++i) {
        all = traffic::merge(all, sets[i]);
    }
    return all;
}

tl::unexpected<Error> no_such_order(JobOrderId id) {
    return fail(Errc::kNotFound, "unknown_job_order", "There is no job order " + id.str() + ".", {},
                {{"order", id.str()}});
}

tl::unexpected<Error> no_such_vehicle(const plant::VehicleId& id) {
    return fail(Errc::kNotFound, "unknown_vehicle", "There is no vehicle " + id.str() + ".", {},
                {{"vehicle", id.str()}});
}

tl::unexpected<Error> wrong_state(const JobOrder& order, const char* method) {
    return fail(Errc::kConflict, "not_in_this_state",
                std::string("A job order in state ") + to_string(order.state) + " cannot be " +
                    method + ".",
                {}, {{"state", to_string(order.state)}, {"method", method}});
}

/// Interruptions that end when the vehicle may move again.
bool is_about_vehicle(const Reason& reason) {
    static const char* const kCodes[] = {"server_restarted",  "vehicle_lost_order",
                                         "vehicle_was_lost",  "vehicle_paused",
                                         "order_not_accepted", "order_rejected",
                                         "identity_conflict"};
    return std::any_of(std::begin(kCodes), std::end(kCodes),
                       [&](const char* code) { return reason.code == code; });
}

void hold_restored_floor(FleetState& fleet, VehicleRun& run) {
    if (run.has_leg()) {
        run.edge_tiles = tiles_of(fleet, run, run.leg());
        fleet.tiles.try_hold(run.record.id, all_of(run.edge_tiles, run.leg().passed_nodes - 1));
    } else {
        free_floor_behind(fleet, run);
    }
}

/// Orders go on only after the person's act of design.md section 4.
void interrupt_after_restart(FleetState& fleet, Time now) {
    bool any_vehicle = false;
    for (auto& [id, order] : fleet.orders) {
        if (is_final(order.state)) continue;
        const plant::VehicleId vehicle =
            order.assigned_vehicle.empty() ? order.wanted_vehicle : order.assigned_vehicle;
        if (vehicle.empty()) any_vehicle = true;
        if (VehicleRun* run = fleet.find(vehicle)) {
            require_person(fleet, *run, {"server_restarted", {}}, now);
        }
    }
    for (auto& [id, run] : fleet.vehicles) {
        if (any_vehicle || run.has_leg()) {
            require_person(fleet, run, {"server_restarted", {}}, now);
        }
    }
}

void restore(FleetState& fleet, StoredFleet stored, Time now) {
    fleet.event_seq = stored.last_event_seq;
    fleet.order_number = stored.last_order_number;
    for (const auto& vehicle : fleet.plant.vehicles) {
        const auto* type = plant::find_vehicle_type(fleet.plant, vehicle.type);
        if (!type) continue;  // validate() refuses such a plant
        VehicleRun& run = fleet.vehicles[vehicle.id];
        run.vehicle = &vehicle;
        run.type = type;
        run.record.id = vehicle.id;
    }
    for (auto& order : stored.orders) fleet.orders.emplace(order.id, std::move(order));
    for (auto& key : stored.idempotency) fleet.idempotency[{key.client, key.key}] = std::move(key);
    for (auto& record : stored.vehicles) {
        VehicleRun* run = fleet.find(record.id);
        if (!run) continue;
        run->record = std::move(record);
        hold_restored_floor(fleet, *run);
    }
    interrupt_after_restart(fleet, now);
}

StationView station_view(const FleetState& fleet, const plant::Station& station) {
    StationView view{station.id, station.number, {}, {}, false, {}};
    for (const auto& [id, run] : fleet.vehicles) {
        if (run.record.at_station == station.id && !run.record.at_station.empty()) {
            view.occupied_by = id;
            // Ready: it stands there and its last stop, measured here, was inside tolerance.
            view.ready = run.record.last_stop_inside && run.record.last_stop_station == station.id &&
                         !run.has_leg();
            if (run.record.last_stop_station == station.id) view.last_stop = run.record.last_stop;
        }
        if (run.has_leg() && run.leg().station == station.id) view.reserved_by = id;
    }
    return view;
}

}  // namespace

class Fleet::Impl : public FleetState {
public:
    using FleetState::FleetState;
};

Fleet::Fleet(const plant::Plant& plant, StoredFleet stored, std::uint64_t id_seed, Time now)
    : impl_(std::make_unique<Impl>(plant, id_seed, now)) {
    restore(*impl_, std::move(stored), now);
}

Fleet::~Fleet() = default;

Result<Created> Fleet::create(const NewOrder& order, Time now) {
    auto created = create_order(*impl_, order, now);
    if (!created || created->repeated) return created;
    dispatch(*impl_, now);
    created->order = *impl_->find(created->order.id);
    return created;
}

namespace {

Result<JobOrder*> find_for_change(FleetState& fleet, JobOrderId id,
                                  std::optional<std::int64_t> if_revision) {
    JobOrder* order = fleet.find(id);
    if (!order) return no_such_order(id);
    if (if_revision && *if_revision != order->revision) {
        return fail(Errc::kConflict, "stale_revision",
                    "The order has changed meanwhile. Read it again, then decide.", {},
                    {{"revision", order->revision}});
    }
    return order;
}

void pause_motion(FleetState& fleet, VehicleRun& run, const char* action_type, Time now) {
    // The newest wish counts: an older pause or unpause still on its way is not sent again.
    std::erase_if(run.actions, [](const PendingAction& pending) {
        return pending.action.type == "startPause" || pending.action.type == "stopPause";
    });
    Action action;
    action.type = action_type;
    send_action(fleet, run, std::move(action), now);
}

}  // namespace

Result<JobOrder> Fleet::pause_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                    const std::string& actor, Time now) {
    auto found = find_for_change(*impl_, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (order.state == JobState::kAllowedToStart) {  // ISA-95: RevokeStart
        set_order_state(*impl_, order, JobState::kNotAllowedToStart,
                        {"paused_by_person", {{"actor", actor}}}, actor, now);
    } else if (order.state == JobState::kRunning) {
        order.pause_requested = true;
        set_order_state(*impl_, order, JobState::kInterrupted,
                        {"paused_by_person", {{"actor", actor}}}, actor, now);
        VehicleRun* run = impl_->find(order.assigned_vehicle);
        if (run && run->has_leg()) pause_motion(*impl_, *run, "startPause", now);
    } else {
        return wrong_state(order, "paused");
    }
    return order;
}

Result<JobOrder> Fleet::resume_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                     const std::string& actor, Time now) {
    auto found = find_for_change(*impl_, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (order.state == JobState::kNotAllowedToStart) {
        set_order_state(*impl_, order, JobState::kAllowedToStart, {}, actor, now);
    } else if (order.state == JobState::kInterrupted && !order.cancel_requested) {
        VehicleRun* run = impl_->find(order.assigned_vehicle);
        if (run && (run->record.needs_resume || run->record.paused)) {
            return fail(Errc::kConflict, "needs_person",
                        "Vehicle " + run->record.id.str() +
                            " waits for a person to let it move again: POST /api/v1/fleet/resume.",
                        {}, {{"vehicle", run->record.id.str()}});
        }
        const bool was_paused = std::exchange(order.pause_requested, false);
        set_order_state(*impl_, order, JobState::kRunning, {}, actor, now);
        if (was_paused && run && run->has_leg()) pause_motion(*impl_, *run, "stopPause", now);
    } else {
        return wrong_state(order, "resumed");
    }
    dispatch(*impl_, now);
    return *impl_->find(id);
}

Result<JobOrder> Fleet::cancel_order(JobOrderId id, std::optional<std::int64_t> if_revision,
                                     const std::string& actor, Time now) {
    auto found = find_for_change(*impl_, id, if_revision);
    if (!found) return fail(found.error());
    JobOrder& order = **found;
    if (is_final(order.state)) return wrong_state(order, "cancelled");
    if (order.cancel_requested) return order;
    order.cancel_requested = true;
    order.reason = {"cancelled_by_person", {{"actor", actor}}};
    impl_->store(order);
    add_event(*impl_, now, "job_order.cancel_requested", id, {}, order.assigned_vehicle, actor);
    VehicleRun* run = impl_->find(order.assigned_vehicle);
    if (run && run->has_leg() && run->leg().order == id) {
        cancel_leg(*impl_, *run, now);
        // A pause that waits at the vehicle would outlive the order that asked for it.
        if (order.pause_requested) pause_motion(*impl_, *run, "stopPause", now);
    } else {
        abort_order(*impl_, order, order.reason, actor, now);
    }
    return order;
}

Result<VehicleView> Fleet::pause_vehicle(const plant::VehicleId& id, const std::string& actor,
                                         Time now) {
    VehicleRun* run = impl_->find(id);
    if (!run) return no_such_vehicle(id);
    if (!run->record.paused) {
        run->record.paused = true;
        impl_->store(*run);
        impl_->out.fleet_changed = true;
        add_event(*impl_, now, "vehicle.paused", {}, run->record.leg, id, actor);
        pause_motion(*impl_, *run, "startPause", now);
        JobOrder* order = order_of(*impl_, id);
        if (order && order->state == JobState::kRunning) {
            set_order_state(*impl_, *order, JobState::kInterrupted,
                            {"vehicle_paused", {{"vehicle", id.str()}, {"actor", actor}}}, actor,
                            now);
        }
    }
    return view_of(*impl_, *run, now);
}

Result<VehicleView> Fleet::init_position(const plant::VehicleId& id, const Pose2& pose,
                                         const std::string& actor, Time now) {
    VehicleRun* run = impl_->find(id);
    if (!run) return no_such_vehicle(id);
    if (!run->connected || !run->reconciled) {
        return fail(Errc::kConflict, "vehicle_silent",
                    "Vehicle " + id.str() + " is not connected. Its position can be set when it is.",
                    {}, {{"vehicle", id.str()}});
    }
    if (run->state.driving || run->has_leg()) {
        return fail(Errc::kConflict, "vehicle_busy",
                    "Vehicle " + id.str() + " has an order. Cancel it before its position is set.",
                    {}, {{"vehicle", id.str()}});
    }
    const auto* hall = plant::find_hall(impl_->plant, plant::HallId(hall_of(*impl_, *run)));
    if (hall && !geometry::contains(hall->outline, pose.position())) {
        return fail(Errc::kUnreachable, "outside_hall",
                    "That position lies outside hall " + hall->name + ".", "/x_m",
                    {{"x_m", pose.x_m}, {"y_m", pose.y_m}});
    }
    std::erase_if(run->actions,
                  [](const PendingAction& p) { return p.action.type == "initPosition"; });
    Action action;
    action.type = "initPosition";
    action.init_position = InitPosition{pose, hall_of(*impl_, *run), {}};
    add_event(*impl_, now, "vehicle.init_position", {}, {}, id, actor,
              {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}});
    send_action(*impl_, *run, std::move(action), now);
    return view_of(*impl_, *run, now);
}

void Fleet::pause_fleet(const std::string& actor, Time now) {
    add_event(*impl_, now, "fleet.paused", {}, {}, {}, actor);
    impl_->out.fleet_changed = true;
    for (const auto& [id, run] : impl_->vehicles) static_cast<void>(pause_vehicle(id, actor, now));
}

Status Fleet::resume_fleet(const std::vector<plant::VehicleId>& vehicles, const std::string& actor,
                           Time now) {
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
        const VehicleRun* run = impl_->find(vehicles[i]);
        const std::string field = "/vehicles/" + std::to_string(i);
        if (!run) {
            return fail(Errc::kUnreachable, "unknown_vehicle",
                        "There is no vehicle " + vehicles[i].str() + ".", field,
                        {{"vehicle", vehicles[i].str()}});
        }
        const bool allowed_back = run->connection_refused;
        if (run->record.needs_resume && !allowed_back && (!run->connected || !run->reconciled)) {
            return fail(Errc::kConflict, "vehicle_silent",
                        "Vehicle " + vehicles[i].str() +
                            " is silent. It can be allowed to move when it is heard again.",
                        field, {{"vehicle", vehicles[i].str()}});
        }
    }
    for (const auto& id : vehicles) {
        VehicleRun& run = *impl_->find(id);
        add_event(*impl_, now, "vehicle.resumed", {}, run.record.leg, id, actor,
                  {{"cause", run.record.needs_resume ? run.record.needs_resume_reason.code
                                                     : std::string("vehicle_paused")}});
        const bool was_paused = std::exchange(run.record.paused, false);
        run.record.needs_resume = false;
        run.record.needs_resume_reason = {};
        run.connection_refused = false;
        impl_->out.fleet_changed = true;
        impl_->store(run);
        if (was_paused || run.state.paused) pause_motion(*impl_, run, "stopPause", now);

        JobOrder* order = order_of(*impl_, id);
        if (run.has_leg() && run.state.order_id != run.leg().id.str()) {
            // The vehicle never got it or gave it up; the step starts anew from where it stands.
            drop_leg(*impl_, run);
            if (order && order->current_step < order->steps.size()) {
                order->steps[order->current_step].state = StepState::kPending;
                impl_->store(*order);
            }
        } else if (run.has_leg() && run.state.order_update_id != run.leg().update_id) {
            cancel_leg(*impl_, run, now);
        }
        if (!order) continue;
        if (order->cancel_requested) {
            if (!run.has_leg()) {
                abort_order(*impl_, *order, order->reason, actor, now);
            } else {
                cancel_leg(*impl_, run, now);
            }
        } else if (order->state == JobState::kInterrupted && is_about_vehicle(order->reason)) {
            set_order_state(*impl_, *order, JobState::kRunning, {}, actor, now);
        }
    }
    dispatch(*impl_, now);
    return {};
}

void Fleet::vehicle_connected(const plant::VehicleId& id, Time now) {
    if (VehicleRun* run = impl_->find(id)) connect(*impl_, *run, now);
}

void Fleet::vehicle_disconnected(const plant::VehicleId& id, Time now) {
    if (VehicleRun* run = impl_->find(id)) disconnect(*impl_, *run, now);
}

void Fleet::vehicle_heard(const plant::VehicleId& id, Time now) {
    if (VehicleRun* run = impl_->find(id)) hear(*impl_, *run, now);
}

void Fleet::vehicle_state(const plant::VehicleId& id, const StateMessage& state, Time now) {
    VehicleRun* run = impl_->find(id);
    if (!run) return;
    take_state(*impl_, *run, state, now);
    dispatch(*impl_, now);
}

void Fleet::vehicle_factsheet(const plant::VehicleId& id, const Factsheet& factsheet, Time now) {
    VehicleRun* run = impl_->find(id);
    if (!run) return;
    run->factsheet = factsheet;
    hear(*impl_, *run, now);
}

void Fleet::vehicle_message_refused(const plant::VehicleId& id, const VehicleError& error,
                                    Time now) {
    Params params{{"text", error.description}};
    for (const auto& [key, value] : error.references) params.push_back({key, value});
    add_event(*impl_, now, "vehicle.message_malformed", {}, {}, id, {}, std::move(params));
}

void Fleet::vehicle_identity_conflict(const plant::VehicleId& id, Time now) {
    VehicleRun* run = impl_->find(id);
    if (!run) return;
    run->connection_refused = true;
    require_person(*impl_, *run, {"identity_conflict", {{"vehicle", id.str()}}}, now);
}

bool Fleet::connection_refused(const plant::VehicleId& id) const {
    const VehicleRun* run = impl_->find(id);
    return run && run->connection_refused;
}

void Fleet::tick(Time now) {
    update_links(*impl_, now);
    resend(*impl_, now);
    dispatch(*impl_, now);
    std::erase_if(impl_->orders, [&](const auto& entry) {
        return is_final(entry.second.state) && now - entry.second.ended > kKeepFinal;
    });
    std::erase_if(impl_->idempotency,
                  [&](const auto& entry) { return now - entry.second.at > kKeepFinal; });
}

Outputs Fleet::take_outputs(Time now) {
    FleetState& fleet = *impl_;
    Outputs out = std::exchange(fleet.out, {});
    for (const auto& id : std::exchange(fleet.stored_orders, {})) {
        if (const JobOrder* order = fleet.find(id)) out.records.orders.push_back(*order);
    }
    for (const auto& id : std::exchange(fleet.stored_vehicles, {})) {
        if (const VehicleRun* run = fleet.find(id)) out.records.vehicles.push_back(run->record);
    }
    for (const auto& id : std::exchange(fleet.changed_vehicles, {})) {
        if (const VehicleRun* run = fleet.find(id)) out.vehicles.push_back(view_of(fleet, *run, now));
    }
    for (const auto& id : std::exchange(fleet.changed_stations, {})) {
        const auto* station = plant::find_station(fleet.plant, id);
        if (station) out.stations.push_back(station_view(fleet, *station));
    }
    return out;
}

Preview Fleet::preview(const NewOrder& order, Time now) const {
    Preview preview;
    preview.vehicle = order.vehicle;
    auto plan = plan_order(*impl_, order, now);
    preview.accepted = plan.has_value();
    if (!plan) preview.problem = plan.error();
    if (plan) preview.vehicle = plan->vehicle;
    const VehicleRun* run = impl_->find(preview.vehicle);
    if (!run) return preview;

    const plant::Station* first = nullptr;
    std::optional<planning::LegPlan> first_plan;
    std::optional<Pose2> pose;
    if (run->record.pose_known) pose = run->record.pose;
    const auto standing = standing_bodies(*impl_, run->record.id);
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        const auto* station = plant::find_station(impl_->plant, order.steps[i].station_number);
        if (!station) break;
        StepPreview step;
        step.station = station->id;
        step.number = station->number;
        step.start = plan ? plan->starts[i] : pose.value_or(Pose2{});
        if (plan || pose) {
            step.options = impl_->planner.assess_modes(
                leg_request(*impl_, *run, step.start, station->id, order.steps[i].mode), standing);
        }
        for (const auto& option : step.options) {
            const bool wanted = order.steps[i].mode == plant::MotionMode::kAuto
                                    ? option.suggested
                                    : option.mode == order.steps[i].mode;
            if (!wanted || !option.plan) continue;
            step.chosen = option.mode;
            if (i == 0) first_plan = *option.plan;
        }
        if (i == 0) first = station;
        pose = station->pose;
        preview.steps.push_back(std::move(step));
    }
    preview.checks = start_checks(*impl_, *run, first, first_plan, now);
    return preview;
}

std::optional<JobOrder> Fleet::order(JobOrderId id) const {
    const JobOrder* order = impl_->find(id);
    return order ? std::optional<JobOrder>(*order) : std::nullopt;
}

std::vector<JobOrder> Fleet::orders() const {
    std::vector<JobOrder> orders;
    for (auto it = impl_->orders.rbegin(); it != impl_->orders.rend(); ++it) {
        orders.push_back(it->second);
    }
    return orders;
}

std::optional<VehicleView> Fleet::vehicle(const plant::VehicleId& id, Time now) const {
    const VehicleRun* run = impl_->find(id);
    return run ? std::optional<VehicleView>(view_of(*impl_, *run, now)) : std::nullopt;
}

std::vector<VehicleView> Fleet::vehicles(Time now) const {
    std::vector<VehicleView> views;
    for (const auto& [id, run] : impl_->vehicles) views.push_back(view_of(*impl_, run, now));
    return views;
}

std::vector<StationView> Fleet::stations() const {
    std::vector<StationView> views;
    for (const auto& station : impl_->plant.stations) views.push_back(station_view(*impl_, station));
    return views;
}

FleetView Fleet::view(Time) const {
    FleetView view;
    view.last_event_seq = impl_->event_seq;
    view.started = impl_->started;
    view.paused = !impl_->vehicles.empty();
    for (const auto& [id, run] : impl_->vehicles) {
        ++view.vehicles_total;
        if (run.link == Link::kLive) ++view.vehicles_live;
        if (run.record.needs_resume) view.needs_resume.push_back(id);
        if (!run.record.paused) view.paused = false;
    }
    return view;
}

}  // namespace pulseline::fleet
