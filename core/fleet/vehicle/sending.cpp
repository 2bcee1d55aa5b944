#include "core/fleet/vehicle/sending.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr Duration kResendEvery = std::chrono::seconds(1);
constexpr int kOrderSends = 10;  // then the order is interrupted and a person decides
constexpr Duration kEscalateAfter = std::chrono::seconds(10);

}  // namespace

void send_order_update(FleetState& fleet, VehicleRun& run, std::size_t from, Time now) {
    const Leg& leg = run.leg();
    vda5050::OrderMessage message;
    message.order_id = leg.id.str();
    message.order_update_id = leg.update_id;
    const auto offset = static_cast<std::ptrdiff_t>(from);
    message.nodes.assign(leg.nodes.begin() + offset, leg.nodes.end());
    message.edges.assign(leg.edges.begin() + offset, leg.edges.end());
    fleet.out.messages.push_back({run.record.id, std::move(message), std::nullopt});
    run.delivery.sent(from, run.connected, now);
}

void cancel_foreign_order(FleetState& fleet, VehicleRun& run, const std::string& actor, Time now) {
    if (is_asked(run, vda5050::kCancelOrder)) return;
    vda5050::Action action;
    action.type = vda5050::kCancelOrder;
    add_event(fleet, now, event::kVehicleForeignOrderCancelled, {}, {}, run.record.id, actor,
              {{"order", run.state.order_id}});
    send_action(fleet, run, std::move(action), now);
}

void cancel_leg(FleetState& fleet, VehicleRun& run, Time now) {
    if (!run.has_leg() || run.delivery.cancelling()) return;
    run.delivery.cancel();
    vda5050::Action action;
    action.type = vda5050::kCancelOrder;
    add_event(fleet, now, event::kLegCancelRequested, run.leg().order, run.leg().id, run.record.id,
              {});
    send_action(fleet, run, std::move(action), now);
}

void send_action(FleetState& fleet, VehicleRun& run, vda5050::Action action, Time now) {
    if (action.id.empty()) action.id = to_string(fleet.ids.next(now));
    PendingAction pending{std::move(action), now, std::nullopt, 0, false};
    if (run.connected && run.reconciled) {
        fleet.out.messages.push_back(
            {run.record.id, std::nullopt, vda5050::InstantActionsMessage{{pending.action}}});
        pending.last_sent = now;
        pending.sends = 1;
    }
    run.actions.push_back(std::move(pending));
}

void pause_motion(FleetState& fleet, VehicleRun& run, const char* action_type, Time now) {
    // The newest wish counts: an older pause or unpause still on its way is not sent again.
    std::erase_if(run.actions, [](const PendingAction& pending) {
        return pending.action.type == vda5050::kStartPause ||
               pending.action.type == vda5050::kStopPause;
    });
    vda5050::Action action;
    action.type = action_type;
    send_action(fleet, run, std::move(action), now);
}

void resend(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) {
        if (!run.connected || !run.reconciled) continue;
        const auto since = run.delivery.unconfirmed_since();
        const bool unconfirmed = run.has_leg() && since && !waits_for_person(run);
        if (unconfirmed && now - *since >= kResendEvery) {
            if (run.delivery.sends() >= kOrderSends) {
                run.delivery.unanswered();
                require_person(fleet, run, {reasons::kOrderNotAccepted, {}}, now);
            } else {
                send_order_update(fleet, run, run.delivery.sent_from(), now);
            }
        }
        for (auto& pending : run.actions) {
            if (pending.last_sent && now - *pending.last_sent < kResendEvery) continue;
            fleet.out.messages.push_back(
                {id, std::nullopt, vda5050::InstantActionsMessage{{pending.action}}});
            pending.last_sent = now;
            ++pending.sends;
            if (!pending.escalated && now - pending.first_sent >= kEscalateAfter) {
                pending.escalated = true;
                add_event(fleet, now, event::kVehicleActionUnconfirmed, {}, run.record.leg, id, {},
                          {{"action", pending.action.type}, {"action_id", pending.action.id}});
            }
        }
    }
}

}  // namespace pulseline::fleet
