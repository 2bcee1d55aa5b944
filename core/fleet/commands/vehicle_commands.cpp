#include <algorithm>
#include <utility>

#include "core/fleet/dispatch/dispatch.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/reports/pose.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/fleet/views/vehicle_views.hpp"
#include "core/vda5050/actions.hpp"

// What people ask of vehicles and of the fleet as a whole.
namespace pulseline::fleet {
namespace {

// A person who says that it stands about where it says means the hall that it says, too.
constexpr double kAsClaimed_m = 1;

tl::unexpected<Error> no_such_vehicle(const plant::VehicleId& id) {
    return fail(Errc::kNotFound, "unknown_vehicle", "There is no vehicle " + id.str() + ".", {},
                {{"vehicle", id.str()}});
}

/// Connected is not enough: only its first report says where it stands and what it does.
Status is_heard(const VehicleRun& run, const std::string& field, const std::string& wanted) {
    const std::string& id = run.record.id.str();
    if (!run.connected) {
        return fail(Errc::kConflict, "vehicle_silent",
                    "Vehicle " + id + " is silent. " + wanted + " when it is heard again.", field,
                    {{"vehicle", id}});
    }
    if (!run.reconciled) {
        return fail(Errc::kConflict, "vehicle_not_reported",
                    "Vehicle " + id + " has connected and not said yet where it stands. " + wanted +
                        " when it has.",
                    field, {{"vehicle", id}});
    }
    return {};
}

/// Interruptions that end when the vehicle may move again.
bool is_about_vehicle(const Reason& reason) {
    static const char* const kCodes[] = {
        reasons::kServerRestarted,        reasons::kVehicleLostOrder, reasons::kVehicleWasLost,
        reasons::kVehiclePaused,          reasons::kOrderNotAccepted, reasons::kOrderRejected,
        reasons::kForeignOrder,           reasons::kIdentityConflict, reasons::kVehicleWithdrawn,
        reasons::kLoadOnWithdrawnVehicle, reasons::kDrivenByHand,     reasons::kPoseJumped,
        reasons::kCommandExpired};
    return std::any_of(std::begin(kCodes), std::end(kCodes),
                       [&](const char* code) { return reason.code == code; });
}

void pause(FleetState& fleet, VehicleRun& run, const std::string& actor, bool with_fleet,
           Time now) {
    if (run.record.paused) return;
    const plant::VehicleId& id = run.record.id;
    run.record.paused = Pause{actor, now, with_fleet};
    fleet.store(run);
    fleet.out.fleet_changed = true;
    add_event(fleet, now, event::kVehiclePaused, {}, run.record.leg, id, actor);
    pause_motion(fleet, run, vda5050::kStartPause, now);
    JobOrder* order = fleet.orders.of(id);
    if (order && order->state == JobState::kRunning) {
        set_order_state(fleet, *order, JobState::kInterrupted,
                        {reasons::kVehiclePaused, {{"vehicle", id.str()}, {"actor", actor}}}, actor,
                        now);
    }
}

void resume_leg(FleetState& fleet, VehicleRun& run, const std::string& actor, Time now) {
    if (has_foreign_order(run)) return cancel_foreign_order(fleet, run, actor, now);
    if (!run.has_leg()) return;
    if (run.state.order_id == run.leg().id.str()) {
        if (run.state.order_update_id != run.leg().update_id) cancel_leg(fleet, run, now);
        return;
    }
    if (is_on_its_way(run)) {
        // It could be begun after it was forgotten here, so the vehicle is asked once more.
        run.delivery.sent_anew();
        return send_order_update(fleet, run, 0, now);
    }
    // The vehicle never got it or gave it up; the step starts anew from where it stands.
    end_leg(fleet, run, LegEnd::kLost, now);
}

void go_on_with(FleetState& fleet, VehicleRun& run, JobOrder& order, const std::string& actor,
                Time now) {
    if (order.cancel_requested) {
        if (run.has_leg()) return cancel_leg(fleet, run, now);
        return abort_order(fleet, order, order.reason, actor, now);
    }
    if (order.state == JobState::kInterrupted && is_about_vehicle(order.reason)) {
        set_order_state(fleet, order, JobState::kRunning, {}, actor, now);
    }
}

}  // namespace

Result<VehicleView> Fleet::pause_vehicle(const plant::VehicleId& id, const std::string& actor,
                                         Time now) {
    FleetState& fleet = input<&Fleet::pause_vehicle>(now, id, actor);
    VehicleRun* run = fleet.find(id);
    if (!run) return no_such_vehicle(id);
    pause(fleet, *run, actor, false, now);
    return view_of(fleet, *run, now);
}

Result<VehicleView> Fleet::init_position(const plant::VehicleId& id, const Pose2& pose,
                                         const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::init_position>(now, id, pose, actor);
    VehicleRun* run = fleet.find(id);
    if (!run) return no_such_vehicle(id);
    if (Status heard = is_heard(*run, {}, "Its position can be set"); !heard) {
        return fail(std::move(heard).error());
    }
    // In doubt its leg is kept after it has given it up, since the floor of it is.
    const bool has_order = run->has_leg() && run->state.order_id == run->leg().id.str() &&
                           !(is_in_doubt(*run) && has_nothing_left(run->state));
    if (run->state.driving || has_order) {
        return fail(Errc::kConflict, "vehicle_busy",
                    "Vehicle " + id.str() + " has an order. Cancel it before its position is set.",
                    {}, {{"vehicle", id.str()}});
    }
    Whereabouts stated{pose, hall_of(fleet, *run)};
    stated.pose.heading_rad = wrap(pose.heading_rad);
    const auto& claim = run->record.claim;
    if (claim && geometry::distance(claim->pose.position(), pose.position()) < kAsClaimed_m) {
        stated.hall = claim->hall;
    }
    const auto* hall = plant::find_hall(fleet.plant, plant::HallId(stated.hall));
    if (hall && !geometry::contains(hall->outline, pose.position())) {
        return fail(Errc::kUnreachable, "outside_hall",
                    "That position lies outside hall " + hall->name + ".", "/x_m",
                    {{"x_m", pose.x_m}, {"y_m", pose.y_m}});
    }
    std::erase_if(run->actions,
                  [](const PendingAction& p) { return p.action.type == vda5050::kInitPosition; });
    vda5050::Action action;
    action.type = vda5050::kInitPosition;
    action.init_position = vda5050::InitPosition{pose, stated.hall, {}};
    run->stated = VehicleRun::Statement{stated, now, actor};
    add_event(fleet, now, event::kVehicleInitPosition, {}, {}, id, actor,
              {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"heading_rad", pose.heading_rad}});
    send_action(fleet, *run, std::move(action), now);
    return view_of(fleet, *run, now);
}

void Fleet::pause_fleet(const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::pause_fleet>(now, actor);
    add_event(fleet, now, event::kFleetPaused, {}, {}, {}, actor);
    fleet.out.fleet_changed = true;
    for (auto& [id, run] : fleet.vehicles) pause(fleet, run, actor, true, now);
}

Status Fleet::resume_fleet(const std::vector<plant::VehicleId>& vehicles, const std::string& actor,
                           Time now) {
    FleetState& fleet = input<&Fleet::resume_fleet>(now, vehicles, actor);
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
        const VehicleRun* run = fleet.find(vehicles[i]);
        const std::string field = "/vehicles/" + std::to_string(i);
        if (!run) {
            return fail(Errc::kUnreachable, "unknown_vehicle",
                        "There is no vehicle " + vehicles[i].str() + ".", field,
                        {{"vehicle", vehicles[i].str()}});
        }
        if (run->record.needs_resume && !is_automatic(*run)) {
            return fail(Errc::kConflict, "not_automatic",
                        "Vehicle " + vehicles[i].str() +
                            " is driven by hand. Give it back at the vehicle first.",
                        field, {{"operating_mode", run->state.operating_mode}});
        }
        if (is_in_doubt(*run) && !stands_where_known(fleet, *run, now)) {
            return fail(Errc::kConflict, "pose_in_doubt",
                        "Vehicle " + vehicles[i].str() +
                            " says that it stands where it cannot be. Look at it and set its "
                            "position first.",
                        field, {{"vehicle", vehicles[i].str()}});
        }
        const bool allowed_back = run->connection_refused;
        if (run->record.needs_resume && !allowed_back) {
            Status heard = is_heard(*run, field, "It can be allowed to move");
            if (!heard) return heard;
        }
    }
    for (const auto& id : vehicles) {
        VehicleRun& run = *fleet.find(id);
        add_event(fleet, now, event::kVehicleResumed, {}, run.record.leg, id, actor,
                  {{"cause", run.record.needs_resume ? run.record.needs_resume_reason.code
                                                     : std::string(reasons::kVehiclePaused)}});
        const bool was_paused = std::exchange(run.record.paused, std::nullopt).has_value();
        run.record.needs_resume = false;
        run.record.needs_resume_reason = {};
        run.connection_refused = false;
        fleet.out.fleet_changed = true;
        fleet.store(run);
        if (was_paused || run.state.paused) pause_motion(fleet, run, vda5050::kStopPause, now);
        if (is_in_doubt(run)) end_doubt(fleet, run, now);

        resume_leg(fleet, run, actor, now);
        JobOrder* order = fleet.orders.of(id);  // none any more when that ended a cancel
        if (order) go_on_with(fleet, run, *order, actor, now);
    }
    dispatch(fleet, now);
    return {};
}

}  // namespace pulseline::fleet
