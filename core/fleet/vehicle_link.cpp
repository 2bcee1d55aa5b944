#include <algorithm>

#include "core/fleet/state.hpp"

// The link to a vehicle: how long it has been silent, and what is sent until the vehicle confirms
// it.
namespace pulseline::fleet {
namespace {

constexpr Duration kResendEvery = std::chrono::seconds(1);
constexpr int kOrderSends = 10;  // then the order is interrupted and a person decides
constexpr Duration kEscalateAfter = std::chrono::seconds(10);

Link link_after(Duration silent) {
    if (silent >= kGoneAfter) return Link::kGone;
    if (silent >= kLostAfter) return Link::kLost;
    if (silent >= kLateAfter) return Link::kLate;
    return Link::kLive;
}

void set_link(FleetState& fleet, VehicleRun& run, Link to, Time now) {
    if (run.link == to) return;
    add_event(fleet, now, "vehicle.link", {}, {}, run.record.id, {},
              {{"from", to_string(run.link)}, {"to", to_string(to)}});
    run.link = to;
    fleet.changed_vehicles.insert(run.record.id);
}

}  // namespace

void hear(FleetState& fleet, VehicleRun& run, Time now) {
    run.last_heard = now;
    set_link(fleet, run, Link::kLive, now);
}

void connect(FleetState& fleet, VehicleRun& run, Time now) {
    run.connected = true;
    run.reconciled = false;
    run.newest_header = 0;
    run.order_sent.reset();  // what was under way on the old connection is lost
    add_event(fleet, now, "vehicle.connected", {}, {}, run.record.id, {});
    hear(fleet, run, now);
    // Without order and pose, nothing tells a cut line from a vehicle that was switched off and on.
    if (run.gave_up) require_person(fleet, run, {"vehicle_lost_order", {}}, now);
}

void disconnect(FleetState& fleet, VehicleRun& run, Time now) {
    if (!run.connected) return;
    run.connected = false;
    run.reconciled = false;
    add_event(fleet, now, "vehicle.disconnected", {}, {}, run.record.id, {});
    fleet.changed_vehicles.insert(run.record.id);
}

bool is_asked(const VehicleRun& run, const char* action_type) {
    return std::any_of(run.actions.begin(), run.actions.end(),
                       [&](const auto& pending) { return pending.action.type == action_type; });
}

void send_action(FleetState& fleet, VehicleRun& run, Action action, Time now) {
    if (action.id.empty()) action.id = to_string(fleet.ids.next(now));
    PendingAction pending{std::move(action), now, std::nullopt, 0, false};
    if (run.connected && run.reconciled) {
        fleet.out.messages.push_back(
            {run.record.id, std::nullopt, InstantActionsMessage{{pending.action}}});
        pending.last_sent = now;
        pending.sends = 1;
    }
    run.actions.push_back(std::move(pending));
}

void pause_motion(FleetState& fleet, VehicleRun& run, const char* action_type, Time now) {
    // The newest wish counts: an older pause or unpause still on its way is not sent again.
    std::erase_if(run.actions, [](const PendingAction& pending) {
        return pending.action.type == "startPause" || pending.action.type == "stopPause";
    });
    Action action;
    action.type = action_type;
    send_action(fleet, run, std::move(action), now);
}

void update_links(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) {
        if (!run.last_heard) continue;
        const Link to = link_after(now - *run.last_heard);
        if (to == run.link) continue;
        set_link(fleet, run, to, now);
        if (to == Link::kLost && run.has_leg()) {
            require_person(fleet, run, {"vehicle_was_lost", {}}, now);
        }
    }
}

void resend(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) {
        if (!run.connected || !run.reconciled) continue;
        const bool unseen = run.has_leg() && run.update_sent && !waits_for_person(run);
        if (unseen && now - *run.update_sent >= kResendEvery) {
            if (run.update_sends >= kOrderSends) {
                run.update_sent.reset();
                require_person(fleet, run, {"order_not_accepted", {}}, now);
            } else {
                send_order_update(fleet, run, run.update_from, now);
            }
        }
        for (auto& pending : run.actions) {
            if (pending.last_sent && now - *pending.last_sent < kResendEvery) continue;
            fleet.out.messages.push_back(
                {id, std::nullopt, InstantActionsMessage{{pending.action}}});
            pending.last_sent = now;
            ++pending.sends;
            if (!pending.escalated && now - pending.first_sent >= kEscalateAfter) {
                pending.escalated = true;
                add_event(fleet, now, "vehicle.action_unconfirmed", {}, run.record.leg, id, {},
                          {{"action", pending.action.type}, {"action_id", pending.action.id}});
            }
        }
    }
}

}  // namespace pulseline::fleet
