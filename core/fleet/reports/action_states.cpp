#include "core/fleet/reports/action_states.hpp"

#include <algorithm>

#include "core/fleet/legs/ending.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/lifts.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr Duration kCancelAgain = std::chrono::seconds(5);

}  // namespace

bool is_final(vda5050::ActionStatus status) {
    return status == vda5050::ActionStatus::kFinished || status == vda5050::ActionStatus::kFailed;
}

const vda5050::ActionState* find_action(const vda5050::StateMessage& state, const std::string& id) {
    for (const auto& action : state.action_states) {
        if (action.id == id) return &action;
    }
    return nullptr;
}

void handle_action_states(FleetState& fleet, LiveVehicle& live, Time now) {
    bool cancelled = false;
    bool again = false;
    std::erase_if(live.actions, [&](PendingAction& pending) {
        const vda5050::ActionState* found = find_action(live.state, pending.action.id);
        if (!found || !is_final(found->status)) return false;
        pending.escalated = true;  // it has answered, whatever else this waits for
        // A cancel is done when the vehicle says so AND stands; floor is freed only then.
        if (pending.action.type == vda5050::kCancelOrder) {
            if (live.state.driving || (live.has_leg() && !live.record.pose_known)) return false;
            // It knew of no order to cancel: that may still be on its way, or have come since.
            const bool failed = found->status == vda5050::ActionStatus::kFailed;
            if (failed && live.has_leg() && is_on_its_way(live)) return false;
            const bool left = failed && live.has_leg() &&
                              live.state.order_id == live.leg().id.str() &&
                              !has_nothing_left(live.state);
            // One that says so for ever is not asked as often as it speaks.
            if (left && now - pending.first_sent < kCancelAgain) return false;
            again = left;
            cancelled = !again;
        }
        note_lift_ended(fleet, live, *found, now);
        add_event(
            fleet, now, event::kVehicleAction, {}, {}, live.record.id, {},
            {{"action", pending.action.type},
             {"action_id", pending.action.id},
             {"status", found->status == vda5050::ActionStatus::kFinished ? "finished" : "failed"},
             {"result", found->result_description}});
        return true;
    });
    if (cancelled) end_leg(fleet, live, LegEnd::kCancelled, now);
    if (!again) return;
    live.delivery.cancel_failed();
    cancel_leg(fleet, live, now);
}

}  // namespace pulseline::fleet
