#include "core/fleet/legs/ending.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/floor/grants.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {

void drop_leg(FleetState& fleet, VehicleRun& run, Time now, bool arrived) {
    run.record.has_leg = false;
    run.record.leg = LegId{};
    run.record.leg_data = Leg{};
    run.leg_seen = false;
    run.update_sent.reset();
    run.update_sends = 0;
    run.order_sent.reset();
    run.gave_up = false;
    run.cancelling = false;
    // Repeated, it would hit the next leg.
    std::erase_if(run.actions,
                  [](const auto& p) { return p.action.type == vda5050::kCancelOrder; });
    run.leg_started.reset();
    run.floor.leg_planned = false;
    run.floor.idle_since.reset();
    settle(fleet, run, now, !arrived);
    fleet.store(run);
}

void abort_order(FleetState& fleet, JobOrder& order, Reason reason, const std::string& actor,
                 Time now) {
    for (std::size_t i = order.current_step; i < order.steps.size(); ++i) {
        if (order.steps[i].state != StepState::kDone) order.steps[i].state = StepState::kSkipped;
    }
    const JobState to = order.stop_requested ? JobState::kEnded : JobState::kAborted;
    set_order_state(fleet, order, to, std::move(reason), actor, now);
    if (VehicleRun* run = fleet.find(order.assigned_vehicle)) give_up_task(fleet, *run, now);
}

void forget_leg(FleetState& fleet, VehicleRun& run, Time now) {
    run.leg_seen = false;
    run.update_sent.reset();
    run.gave_up = true;
    if (!run.record.pose_known) return;
    drop_leg(fleet, run, now);
    JobOrder* order = fleet.orders.of(run.record.id);
    if (!order || order->current_step >= order->steps.size()) return;
    order->steps[order->current_step].state = StepState::kPending;
    fleet.store(*order);
    if (order->cancel_requested && !run.record.needs_resume) {
        abort_order(fleet, *order, order->reason, {}, now);
    }
}

void interrupt(FleetState& fleet, const VehicleRun& run, const std::string& actor, Time now) {
    JobOrder* order = fleet.orders.of(run.record.id);
    if (!order || order->state != JobState::kRunning) return;
    const char* code = is_loaded(run) ? "load_on_withdrawn_vehicle" : "vehicle_withdrawn";
    set_order_state(fleet, *order, JobState::kInterrupted,
                    {code, {{"vehicle", run.record.id.str()}}}, actor, now);
}

void finish_cancel(FleetState& fleet, VehicleRun& run, Time now) {
    JobOrder* order = fleet.orders.of(run.record.id);
    drop_leg(fleet, run, now);
    if (!order) return;
    if (order->current_step < order->steps.size()) {
        order->steps[order->current_step].state = StepState::kPending;
        order->steps[order->current_step].leg = {};
    }
    if (order->cancel_requested) {
        abort_order(fleet, *order, order->reason, {}, now);
    } else {
        fleet.store(*order);
    }
}

}  // namespace pulseline::fleet
