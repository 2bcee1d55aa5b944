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
#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/views/vehicle_views.hpp"

// How far a vehicle takes part, and what becomes of its order when it is taken out.
namespace pulseline::fleet {
namespace {

/// It is carried or driven out of the hall: nobody waits for what it was told, its floor is free.
void take_off_floor(FleetState& fleet, VehicleRun& run, Time now) {
    run.actions.clear();
    run.record.at_station = {};
    run.record.pose_known = false;
    run.record.pose = {};
    run.record.hall = {};
    run.record.claim.reset();
    run.claim_told.reset();
    run.claim_left = false;
    run.stated.reset();
    JobOrder* order = fleet.orders.of(run.record.id);
    end_leg(fleet, run, LegEnd::kOffFloor, now);
    leave_floor(fleet, run, now);
    if (order && order->cancel_requested) abort_order(fleet, *order, order->reason, {}, now);
}

}  // namespace

Result<VehicleView> Fleet::integrate(const plant::VehicleId& id, Integration level, bool off_floor,
                                     const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::integrate>(now, id, level, off_floor, actor);
    VehicleRun* run = fleet.find(id);
    if (!run) {
        return fail(Errc::kNotFound, "unknown_vehicle", "There is no vehicle " + id.str() + ".", {},
                    {{"vehicle", id.str()}});
    }
    const Integration before = run->record.integration;
    if (level == before) return view_of(fleet, *run, now);
    const bool leaves = level < Integration::kRespect && before >= Integration::kRespect;
    if (leaves && !off_floor) {
        return fail(Errc::kConflict, "off_floor_unconfirmed",
                    "The floor under " + id.str() +
                        " becomes free for others. Take it out of the hall first, then confirm it "
                        "with off_floor.",
                    "/off_floor", {{"vehicle", id.str()}});
    }
    if (leaves && run->connected && run->state.driving) {
        return fail(Errc::kConflict, "vehicle_busy",
                    "Vehicle " + id.str() + " drives. Pause it and wait until it stands.", {},
                    {{"vehicle", id.str()}});
    }
    run->record.integration = level;
    fleet.store(*run);
    fleet.out.fleet_changed = true;
    add_event(fleet, now, event::kVehicleIntegration, {}, run->record.leg, id, actor,
              {{"from", to_string(before)}, {"to", to_string(level)}});
    if (level != Integration::kUtilise) {
        interrupt(fleet, *run, actor, now);
        if (!leaves) cancel_leg(fleet, *run, now);
    }
    if (leaves) take_off_floor(fleet, *run, now);
    if (level == Integration::kIgnore) {
        run->state = {};
        run->state_at.reset();
    }
    if (before < Integration::kRespect && level >= Integration::kRespect) {
        // Somebody put it there by hand: it moves when a person has seen where it stands.
        require_person(fleet, *run, {"integrated_again", {}}, now);
        run->reconciled = false;  // its next report says where it stands
    }
    halt_or_resume(fleet, *run, now);
    dispatch(fleet, now);
    return view_of(fleet, *run, now);
}

}  // namespace pulseline::fleet
