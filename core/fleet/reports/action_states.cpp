#include "core/fleet/reports/action_states.hpp"

#include <algorithm>

#include "core/fleet/legs/ending.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {

bool is_final(vda5050::ActionStatus status) {
    return status == vda5050::ActionStatus::kFinished || status == vda5050::ActionStatus::kFailed;
}

const vda5050::ActionState* find_action(const vda5050::StateMessage& state, const std::string& id) {
    for (const auto& action : state.action_states) {
        if (action.id == id) return &action;
    }
    return nullptr;
}

void take_action_states(FleetState& fleet, VehicleRun& run, Time now) {
    bool cancelled = false;
    bool again = false;
    std::erase_if(run.actions, [&](const PendingAction& pending) {
        const vda5050::ActionState* found = find_action(run.state, pending.action.id);
        if (!found || !is_final(found->status)) return false;
        // A cancel is done when the vehicle says so AND stands; floor is freed only then.
        if (pending.action.type == vda5050::kCancelOrder) {
            if (run.state.driving || (run.has_leg() && !run.record.pose_known)) return false;
            // It knew of no order to cancel: that may still be on its way, or have come since.
            const bool failed = found->status == vda5050::ActionStatus::kFailed;
            if (failed && run.has_leg() && is_on_its_way(run)) return false;
            again = failed && run.has_leg() && run.state.order_id == run.leg().id.str() &&
                    !has_nothing_left(run.state);
            cancelled = !again;
        }
        add_event(
            fleet, now, event::kVehicleAction, {}, {}, run.record.id, {},
            {{"action", pending.action.type},
             {"action_id", pending.action.id},
             {"status", found->status == vda5050::ActionStatus::kFinished ? "finished" : "failed"},
             {"result", found->result_description}});
        return true;
    });
    if (cancelled) end_leg(fleet, run, LegEnd::kCancelled, now);
    if (!again) return;
    run.delivery.cancel_failed();
    cancel_leg(fleet, run, now);
}

}  // namespace pulseline::fleet
