#include "core/fleet/state/events.hpp"

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {
namespace {

/// Reasons are the same wait while their code and names stay; numbers in them may drift.
bool same_wait(const Reason& a, const Reason& b) {
    if (a.code != b.code) return false;
    const auto names = [](const Reason& reason) {
        std::vector<std::string> found;
        for (const auto& param : reason.params) {
            if (const auto* text = std::get_if<std::string>(&param.value)) found.push_back(*text);
        }
        return found;
    };
    return names(a) == names(b);
}

}  // namespace

void add_event(FleetState& fleet, Time now, std::string type, JobOrderId order, LegId leg,
               const plant::VehicleId& vehicle, const std::string& actor, Params params) {
    fleet.out.records.events.push_back(
        {++fleet.event_seq, now, std::move(type), order, leg, vehicle, actor, std::move(params)});
}

void set_order_state(FleetState& fleet, JobOrder& order, JobState to, Reason reason,
                     const std::string& actor, Time now) {
    const JobState from = order.state;
    order.state = to;
    order.reason = std::move(reason);
    if (to == JobState::kRunning && order.started == Time{}) order.started = now;
    if (to != JobState::kRunning) order.expected.reset();
    if (is_final(to)) {
        order.ended = now;
        fleet.orders.close(order);
    }
    Params params{{"from", to_string(from)}, {"to", to_string(to)}};
    if (!order.reason.code.empty()) params.push_back({"reason", order.reason.code});
    for (const auto& param : order.reason.params) params.push_back(param);
    add_event(fleet, now, event::kJobOrderState, order.id, {}, order.assigned_vehicle, actor,
              std::move(params));
    fleet.store(order);
}

void set_order_reason(FleetState& fleet, JobOrder& order, Reason reason, Time now) {
    if (same_wait(order.reason, reason)) return;
    order.reason = std::move(reason);
    if (!order.reason.code.empty()) {
        order.expected.reset();  // until it goes on
        Params params{{"reason", order.reason.code}};
        for (const auto& param : order.reason.params) params.push_back(param);
        add_event(fleet, now, event::kJobOrderWaits, order.id, {}, order.assigned_vehicle, {},
                  std::move(params));
    }
    fleet.store(order);
}

}  // namespace pulseline::fleet
