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
void drop(FleetState& fleet, LiveVehicle& live, Time now, bool arrived) {
    live.record.has_leg = false;
    live.record.leg = LegId{};
    live.record.leg_data = Leg{};
    live.delivery.begin();
    // Repeated, it would hit the next leg.
    std::erase_if(live.actions,
                  [](const auto& p) { return p.action.type == vda5050::kCancelOrder; });
    live.floor.leg_planned = false;
    live.floor.idle_since.reset();
    hold_where_it_stands(fleet, live, now, !arrived);
    fleet.store(live);
}

bool begins_anew(LegEnd end) {
    return end == LegEnd::kCancelled || end == LegEnd::kLost || end == LegEnd::kUnsent;
}

/// The order's present step as if nothing had been sent for it.
void begin_step_anew(FleetState& fleet, const LiveVehicle& live, JobOrder& order, LegEnd end,
                     Time now) {
    const bool has_step = order.current_step < order.steps.size();
    if (!has_step && end == LegEnd::kLost) return;
    if (has_step) {
        Step& step = order.steps[order.current_step];
        step.state = StepState::kPending;
        if (end != LegEnd::kLost) step.leg = {};  // of a lost one it still says which it was
    }
    // Who has to look at the vehicle first decides about its order, too.
    const bool asks = end == LegEnd::kLost && live.record.needs_resume;
    const bool gives_up = order.cancel_requested && end != LegEnd::kUnsent && !asks;
    if (!gives_up || end == LegEnd::kLost) fleet.store(order);
    if (gives_up) abort_order(fleet, order, order.reason, {}, now);
}

}  // namespace

void end_leg(FleetState& fleet, LiveVehicle& live, LegEnd end, Time now) {
    if (end == LegEnd::kLost) {
        live.delivery.give_up();
        if (!live.record.pose_known) return;
    }
    const Leg& leg = live.leg();
    const bool arrived = end == LegEnd::kDone ||
                         (end == LegEnd::kAnotherApproach && leg.passed_nodes == leg.nodes.size());
    // A drive that was not sent begins nothing anew but its own order; a cancelled or lost one, the
    // order that the vehicle has.
    JobOrder* order =
        end == LegEnd::kUnsent ? fleet.find(leg.order) : fleet.orders.of(live.record.id);
    drop(fleet, live, now, arrived);
    if (order && begins_anew(end)) begin_step_anew(fleet, live, *order, end, now);
}

void abort_order(FleetState& fleet, JobOrder& order, Reason reason, const std::string& actor,
                 Time now) {
    for (std::size_t i = order.current_step; i < order.steps.size(); ++i) {
        if (order.steps[i].state != StepState::kDone) order.steps[i].state = StepState::kSkipped;
    }
    const JobState to = order.stop_requested ? JobState::kEnded : JobState::kAborted;
    set_order_state(fleet, order, to, std::move(reason), actor, now);
    if (LiveVehicle* live = fleet.find(order.assigned_vehicle)) give_up_task(fleet, *live, now);
}

void interrupt(FleetState& fleet, const LiveVehicle& live, const std::string& actor, Time now) {
    JobOrder* order = fleet.orders.of(live.record.id);
    if (!order || order->state != JobState::kRunning) return;
    const char* code =
        is_loaded(live) ? reasons::kLoadOnWithdrawnVehicle : reasons::kVehicleWithdrawn;
    set_order_state(fleet, *order, JobState::kInterrupted,
                    {code, {{"vehicle", live.record.id.str()}}}, actor, now);
}

}  // namespace pulseline::fleet
