#include "core/fleet/dispatch/dispatch.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/legs/ending.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/lifts.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/views/vehicle_views.hpp"

// How far a vehicle takes part, and what becomes of its order when it is taken out.
namespace pulseline::fleet {
namespace {

/// It is carried or driven out of the hall: nobody waits for what it was told, its floor is free.
void take_off_floor(FleetState& fleet, LiveVehicle& live, Time now) {
    give_up_lift(fleet, live, now);
    live.actions.clear();
    live.record.at_station = {};
    live.record.pose_known = false;
    live.record.pose = {};
    live.record.hall = {};
    live.record.claim.reset();
    live.claim_told.reset();
    live.claim_left = false;
    live.stated.reset();
    JobOrder* order = fleet.orders.of(live.record.id);
    end_leg(fleet, live, LegEnd::kOffFloor, now);
    leave_floor(fleet, live, now);
    if (order && order->cancel_requested) abort_order(fleet, *order, order->reason, {}, now);
}

}  // namespace

Result<VehicleView> Fleet::integrate(const plant::VehicleId& id, Integration level, bool off_floor,
                                     const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::integrate>(now, id, level, off_floor, actor);
    LiveVehicle* live = fleet.find(id);
    if (!live) {
        return fail(Errc::kNotFound, "unknown_vehicle", "There is no vehicle " + id.str() + ".", {},
                    {{"vehicle", id.str()}});
    }
    const Integration before = live->record.integration;
    if (level == before) return view_of(fleet, *live, now);
    const bool leaves = level < Integration::kRespect && before >= Integration::kRespect;
    if (leaves && !off_floor) {
        return fail(Errc::kConflict, "off_floor_unconfirmed",
                    "The floor under " + id.str() +
                        " becomes free for others. Take it out of the hall first, then confirm it "
                        "with off_floor.",
                    "/off_floor", {{"vehicle", id.str()}});
    }
    if (leaves && live->connected && live->state.driving) {
        return fail(Errc::kConflict, "vehicle_busy",
                    "Vehicle " + id.str() + " drives. Pause it and wait until it stands.", {},
                    {{"vehicle", id.str()}});
    }
    live->record.integration = level;
    fleet.store(*live);
    fleet.out.fleet_changed = true;
    add_event(fleet, now, event::kVehicleIntegration, {}, live->record.leg, id, actor,
              {{"from", to_string(before)}, {"to", to_string(level)}});
    if (level != Integration::kUtilise) {
        interrupt(fleet, *live, actor, now);
        if (!leaves) cancel_leg(fleet, *live, now);
    }
    if (leaves) take_off_floor(fleet, *live, now);
    if (level == Integration::kIgnore) {
        live->state = {};
        live->state_at.reset();
    }
    if (before < Integration::kRespect && level >= Integration::kRespect) {
        // Somebody put it there by hand: it moves when a person has seen where it stands.
        require_person(fleet, *live, {"integrated_again", {}}, now);
        live->reconciled = false;  // its next report says where it stands
    }
    halt_or_resume(fleet, *live, now);
    dispatch(fleet, now);
    return view_of(fleet, *live, now);
}

}  // namespace pulseline::fleet
