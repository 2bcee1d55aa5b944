#include "core/fleet/legs/ending.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/floor/grants.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

/// The vehicle has no leg any more. `arrived`: nor anything left of its plan.
void drop(FleetState& fleet, VehicleRun& run, Time now, bool arrived) {
    run.record.has_leg = false;
    run.record.leg = LegId{};
    run.record.leg_data = Leg{};
    run.delivery.begin();
    // Repeated, it would hit the next leg.
    std::erase_if(run.actions,
                  [](const auto& p) { return p.action.type == vda5050::kCancelOrder; });
    run.floor.leg_planned = false;
    run.floor.idle_since.reset();
    settle(fleet, run, now, !arrived);
    fleet.store(run);
}

bool begins_anew(LegEnd end) {
    return end == LegEnd::kCancelled || end == LegEnd::kLost || end == LegEnd::kUnsent;
}

/// The order's present step as if nothing had been sent for it.
void begin_step_anew(FleetState& fleet, const VehicleRun& run, JobOrder& order, LegEnd end,
                     Time now) {
    const bool has_step = order.current_step < order.steps.size();
    if (!has_step && end == LegEnd::kLost) return;
    if (has_step) {
        Step& step = order.steps[order.current_step];
        step.state = StepState::kPending;
        if (end != LegEnd::kLost) step.leg = {};  // of a lost one it still says which it was
    }
    // Who has to look at the vehicle first decides about its order, too.
    const bool asks = end == LegEnd::kLost && run.record.needs_resume;
    const bool gives_up = order.cancel_requested && end != LegEnd::kUnsent && !asks;
    if (!gives_up || end == LegEnd::kLost) fleet.store(order);
    if (gives_up) abort_order(fleet, order, order.reason, {}, now);
}

}  // namespace

void end_leg(FleetState& fleet, VehicleRun& run, LegEnd end, Time now) {
    if (end == LegEnd::kLost) {
        run.delivery.give_up();
        if (!run.record.pose_known) return;
    }
    const Leg& leg = run.leg();
    const bool arrived = end == LegEnd::kDone ||
                         (end == LegEnd::kAnotherApproach && leg.passed_nodes == leg.nodes.size());
    // A drive that was not sent begins nothing anew but its own order; a cancelled or lost one, the
    // order that the vehicle has.
    JobOrder* order =
        end == LegEnd::kUnsent ? fleet.find(leg.order) : fleet.orders.of(run.record.id);
    drop(fleet, run, now, arrived);
    if (order && begins_anew(end)) begin_step_anew(fleet, run, *order, end, now);
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

void interrupt(FleetState& fleet, const VehicleRun& run, const std::string& actor, Time now) {
    JobOrder* order = fleet.orders.of(run.record.id);
    if (!order || order->state != JobState::kRunning) return;
    const char* code =
        is_loaded(run) ? reasons::kLoadOnWithdrawnVehicle : reasons::kVehicleWithdrawn;
    set_order_state(fleet, *order, JobState::kInterrupted,
                    {code, {{"vehicle", run.record.id.str()}}}, actor, now);
}

}  // namespace pulseline::fleet
