#include "core/fleet/dispatch/dispatch.hpp"

#include "core/fleet/dispatch/assign_waiting.hpp"
#include "core/fleet/dispatch/charging.hpp"
#include "core/fleet/dispatch/extend_bases.hpp"
#include "core/fleet/dispatch/park_idle.hpp"
#include "core/fleet/dispatch/ready_for.hpp"
#include "core/fleet/dispatch/release_withdrawn.hpp"
#include "core/fleet/dispatch/start_steps.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/floor/watch.hpp"
#include "core/fleet/legs/expected_end.hpp"
#include "core/fleet/legs/legs.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/link.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {

void dispatch_for(FleetState& fleet, LiveVehicle& live, Time now) {
    if (may_extend_base(fleet, live, now)) extend_base(fleet, live, now);
    JobOrder* order = fleet.orders.of(live.record.id);
    if (live.has_leg() || !order || order->state != JobState::kRunning) return;
    if (order->current_step >= order->steps.size()) return;
    if (!not_ready_for(fleet, *order, live, now)) start_step(fleet, *order, live, now);
}

void dispatch(FleetState& fleet, Time now) {
    update_links(fleet, now);  // a command may be the first thing after the server stood still
    halt_those_that_cannot_move(fleet, now);
    extend_bases(fleet, now);  // vehicles at work
    release_withdrawn(fleet, now);
    assign_waiting(fleet, now);  // vehicles free
    start_steps(fleet, now);
    charge_low(fleet, now);  // vehicles without an order
    park_idle(fleet, now);
    improve_floor(fleet, now);  // vehicles that wait
    renew_expected_ends(fleet, now);
    check_whole_floor(fleet, now);
}

}  // namespace pulseline::fleet
