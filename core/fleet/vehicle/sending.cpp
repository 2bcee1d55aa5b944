#include "core/fleet/vehicle/sending.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/markers_under_way.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr Duration kResendEvery = std::chrono::seconds(1);
constexpr int kOrderSends = 10;  // then the order is interrupted and a person decides
constexpr Duration kEscalateAfter = std::chrono::seconds(10);

}  // namespace

void send_order_update(FleetState& fleet, LiveVehicle& live, std::size_t from, Time now) {
    const Leg& leg = live.leg();
    vda5050::OrderMessage message;
    message.order_id = leg.id.str();
    message.order_update_id = leg.update_id;
    const auto offset = static_cast<std::ptrdiff_t>(from);
    message.nodes.assign(leg.nodes.begin() + offset, leg.nodes.end());
    message.edges.assign(leg.edges.begin() + offset, leg.edges.end());
    observe_markers(fleet, live, leg.hall, message);
    fleet.out.messages.push_back({live.record.id, std::move(message), std::nullopt});
    live.delivery.sent(from, live.connected, now);
}

void cancel_foreign_order(FleetState& fleet, LiveVehicle& live, const std::string& actor,
                          Time now) {
    if (is_asked(live, vda5050::kCancelOrder)) return;
    vda5050::Action action;
    action.type = vda5050::kCancelOrder;
    add_event(fleet, now, event::kVehicleForeignOrderCancelled, {}, {}, live.record.id, actor,
              {{"order", live.state.order_id}});
    send_action(fleet, live, std::move(action), now);
}

void cancel_leg(FleetState& fleet, LiveVehicle& live, Time now) {
    if (!live.has_leg() || live.delivery.cancelling()) return;
    live.delivery.cancel();
    vda5050::Action action;
    action.type = vda5050::kCancelOrder;
    add_event(fleet, now, event::kLegCancelRequested, live.leg().order, live.leg().id,
              live.record.id, {});
    send_action(fleet, live, std::move(action), now);
}

void send_action(FleetState& fleet, LiveVehicle& live, vda5050::Action action, Time now) {
    if (action.id.empty()) action.id = to_string(fleet.ids.next(now));
    PendingAction pending{std::move(action), now, std::nullopt, 0, false};
    if (live.connected && live.reconciled) {
        fleet.out.messages.push_back(
            {live.record.id, std::nullopt, vda5050::InstantActionsMessage{{pending.action}}});
        pending.last_sent = now;
        pending.sends = 1;
    }
    live.actions.push_back(std::move(pending));
}

void pause_motion(FleetState& fleet, LiveVehicle& live, const char* action_type, Time now) {
    // The newest wish counts: an older pause or unpause still on its way is not sent again.
    std::erase_if(live.actions, [](const PendingAction& pending) {
        return pending.action.type == vda5050::kStartPause ||
               pending.action.type == vda5050::kStopPause;
    });
    vda5050::Action action;
    action.type = action_type;
    send_action(fleet, live, std::move(action), now);
}

namespace {

bool is_shown(const LiveVehicle& live, const vda5050::Action& action) {
    return std::ranges::find(live.state.action_states, action.id, &vda5050::ActionState::id) !=
           live.state.action_states.end();
}

}  // namespace

void resend(FleetState& fleet, Time now) {
    for (auto& [id, live] : fleet.vehicles) {
        if (!live.connected || !live.reconciled) continue;
        const auto since = live.delivery.unconfirmed_since();
        const bool unconfirmed = live.has_leg() && since && !waits_for_person(live);
        if (unconfirmed && now - *since >= kResendEvery) {
            if (live.delivery.sends() >= kOrderSends) {
                live.delivery.unanswered();
                require_person(fleet, live, {reasons::kOrderNotAccepted, {}}, now);
            } else {
                send_order_update(fleet, live, live.delivery.sent_from(), now);
            }
        }
        for (auto& pending : live.actions) {
            if (pending.last_sent && now - *pending.last_sent < kResendEvery) continue;
            // It is at it, and says so: it takes as long as it takes.
            if (is_shown(live, pending.action)) continue;
            // Late it would begin when nobody looks any more.
            if (vda5050::is_lift(pending.action.type) && live.link != Link::kLive) continue;
            fleet.out.messages.push_back(
                {id, std::nullopt, vda5050::InstantActionsMessage{{pending.action}}});
            pending.last_sent = now;
            ++pending.sends;
            if (!pending.escalated && now - pending.first_sent >= kEscalateAfter) {
                pending.escalated = true;
                add_event(fleet, now, event::kVehicleActionUnconfirmed, {}, live.record.leg, id, {},
                          {{"action", pending.action.type}, {"action_id", pending.action.id}});
            }
        }
    }
}

}  // namespace pulseline::fleet
