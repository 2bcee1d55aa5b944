#include <algorithm>
#include <utility>

#include "core/fleet/commands/reachable.hpp"
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

/// Interruptions that end when the vehicle may move again.
bool is_about_vehicle(const Reason& reason) {
    static const char* const kCodes[] = {
        reasons::kServerRestarted,  reasons::kVehicleLostOrder,
        reasons::kVehicleWasLost,   reasons::kVehiclePaused,
        reasons::kOrderNotAccepted, reasons::kOrderRejected,
        reasons::kForeignOrder,     reasons::kIdentityConflict,
        reasons::kVehicleWithdrawn, reasons::kLoadOnWithdrawnVehicle,
        reasons::kDrivenByHand,     reasons::kPoseJumped,
        reasons::kPoseLost,         reasons::kCommandExpired,
        reasons::kVehicleError};
    return std::any_of(std::begin(kCodes), std::end(kCodes),
                       [&](const char* code) { return reason.code == code; });
}

void pause(FleetState& fleet, LiveVehicle& live, const std::string& actor, bool with_fleet,
           Time now) {
    if (live.record.paused) return;
    const plant::VehicleId& id = live.record.id;
    live.record.paused = Pause{actor, now, with_fleet};
    fleet.store(live);
    fleet.out.fleet_changed = true;
    add_event(fleet, now, event::kVehiclePaused, {}, live.record.leg, id, actor);
    pause_motion(fleet, live, vda5050::kStartPause, now);
    JobOrder* order = fleet.orders.of(id);
    if (order && order->state == JobState::kRunning) {
        set_order_state(fleet, *order, JobState::kInterrupted,
                        {reasons::kVehiclePaused, {{"vehicle", id.str()}, {"actor", actor}}}, actor,
                        now);
    }
}

void resume_leg(FleetState& fleet, LiveVehicle& live, const std::string& actor, Time now) {
    if (has_foreign_order(live)) return cancel_foreign_order(fleet, live, actor, now);
    if (!live.has_leg()) return;
    if (live.state.order_id == live.leg().id.str()) {
        if (live.state.order_update_id != live.leg().update_id) cancel_leg(fleet, live, now);
        return;
    }
    if (is_on_its_way(live)) {
        // It could be begun after it was forgotten here, so the vehicle is asked once more.
        live.delivery.sent_anew();
        return send_order_update(fleet, live, 0, now);
    }
    // The vehicle never got it or gave it up; the step starts anew from where it stands.
    end_leg(fleet, live, LegEnd::kLost, now);
}

void go_on_with(FleetState& fleet, LiveVehicle& live, JobOrder& order, const std::string& actor,
                Time now) {
    if (order.cancel_requested) {
        if (live.has_leg()) return cancel_leg(fleet, live, now);
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
    LiveVehicle* live = fleet.find(id);
    if (!live) return no_such_vehicle(id);
    pause(fleet, *live, actor, false, now);
    return view_of(fleet, *live, now);
}

Result<VehicleView> Fleet::init_position(const plant::VehicleId& id, const StatedPose& stated,
                                         const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::init_position>(now, id, stated, actor);
    LiveVehicle* live = fleet.find(id);
    if (!live) return no_such_vehicle(id);
    if (Status heard = is_heard(*live, {}, "Its position can be set"); !heard) {
        return fail(std::move(heard).error());
    }
    // As long as nobody knows where it stands, its leg is kept after it has given it up, since the
    // floor of it is.
    const bool unknown = is_in_doubt(*live) || !live->record.pose_known;
    const bool has_order = live->has_leg() && live->state.order_id == live->leg().id.str() &&
                           !(unknown && has_nothing_left(live->state));
    if (live->state.driving || has_order) {
        const char* remedy = unknown
                                 ? " still gives up its way. Say its position again in a moment."
                                 : " has an order. Cancel it before its position is set.";
        return fail(Errc::kConflict, "vehicle_busy", "Vehicle " + id.str() + remedy, {},
                    {{"vehicle", id.str()}});
    }
    const Pose2& pose = stated.pose;
    Whereabouts where{pose, hall_of(fleet, *live)};
    where.pose.heading_rad = wrap(pose.heading_rad);
    const auto& claim = live->record.claim;
    if (claim && geometry::distance(claim->pose.position(), pose.position()) < kAsClaimed_m) {
        where.hall = claim->hall;
    }
    const auto* hall = plant::find_hall(fleet.plant, plant::HallId(where.hall));
    if (hall && !geometry::contains(hall->outline, pose.position())) {
        return fail(Errc::kUnreachable, "outside_hall",
                    "That position lies outside hall " + hall->name + ".", "/x_m",
                    {{"x_m", pose.x_m}, {"y_m", pose.y_m}});
    }
    std::erase_if(live->actions,
                  [](const PendingAction& p) { return p.action.type == vda5050::kInitPosition; });
    vda5050::Action action;
    action.type = vda5050::kInitPosition;
    action.init_position =
        vda5050::InitPosition{pose, where.hall, {}, stated.sigma_xy_m, stated.sigma_heading_rad};
    live->stated = LiveVehicle::Statement{where, now, actor};
    add_event(fleet, now, event::kVehicleInitPosition, {}, {}, id, actor,
              {{"x_m", pose.x_m},
               {"y_m", pose.y_m},
               {"heading_rad", pose.heading_rad},
               {"sigma_xy_m", stated.sigma_xy_m},
               {"sigma_heading_rad", stated.sigma_heading_rad}});
    send_action(fleet, *live, std::move(action), now);
    return view_of(fleet, *live, now);
}

void Fleet::pause_fleet(const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::pause_fleet>(now, actor);
    add_event(fleet, now, event::kFleetPaused, {}, {}, {}, actor);
    fleet.out.fleet_changed = true;
    for (auto& [id, live] : fleet.vehicles) pause(fleet, live, actor, true, now);
}

Status Fleet::resume_fleet(const std::vector<plant::VehicleId>& vehicles, const std::string& actor,
                           Time now) {
    FleetState& fleet = input<&Fleet::resume_fleet>(now, vehicles, actor);
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
        const LiveVehicle* live = fleet.find(vehicles[i]);
        const std::string field = "/vehicles/" + std::to_string(i);
        if (!live) {
            return fail(Errc::kUnreachable, "unknown_vehicle",
                        "There is no vehicle " + vehicles[i].str() + ".", field,
                        {{"vehicle", vehicles[i].str()}});
        }
        if (live->record.needs_resume && !is_automatic(*live)) {
            return fail(Errc::kConflict, "not_automatic",
                        "Vehicle " + vehicles[i].str() +
                            " is driven by hand. Give it back at the vehicle first.",
                        field, {{"operating_mode", live->state.operating_mode}});
        }
        if (is_in_doubt(*live) && !stands_where_known(fleet, *live, now)) {
            return fail(Errc::kConflict, "pose_in_doubt",
                        "Vehicle " + vehicles[i].str() +
                            " says that it stands where it cannot be. Look at it and set its "
                            "position first.",
                        field, {{"vehicle", vehicles[i].str()}});
        }
        const bool allowed_back = live->connection_refused;
        if (live->record.needs_resume && !allowed_back) {
            Status heard = is_heard(*live, field, "It can be allowed to move");
            if (!heard) return heard;
        }
    }
    for (const auto& id : vehicles) {
        LiveVehicle& live = *fleet.find(id);
        add_event(fleet, now, event::kVehicleResumed, {}, live.record.leg, id, actor,
                  {{"cause", live.record.needs_resume ? live.record.needs_resume_reason.code
                                                      : std::string(reasons::kVehiclePaused)}});
        const bool was_paused = std::exchange(live.record.paused, std::nullopt).has_value();
        live.record.needs_resume = false;
        live.record.needs_resume_reason = {};
        live.connection_refused = false;
        fleet.out.fleet_changed = true;
        fleet.store(live);
        // It is also what a vehicle is let go on with that has stopped for an error of its own.
        if (was_paused || live.state.paused || fatal_error(live)) {
            pause_motion(fleet, live, vda5050::kStopPause, now);
        }
        if (is_in_doubt(live)) end_doubt(fleet, live, now);

        resume_leg(fleet, live, actor, now);
        JobOrder* order = fleet.orders.of(id);  // none any more when that ended a cancel
        if (order) go_on_with(fleet, live, *order, actor, now);
    }
    dispatch(fleet, now);
    return {};
}

}  // namespace pulseline::fleet
