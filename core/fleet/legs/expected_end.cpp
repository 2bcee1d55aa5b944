#include "core/fleet/legs/expected_end.hpp"

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/body.hpp"

// When an order's last drive should end: a promise to people, so it is never one that has passed.
namespace pulseline::fleet {
namespace {

constexpr Duration kAlmostOver = std::chrono::seconds(1);

double left_of_leg_s(const Leg& leg) {
    double all_s = 0;
    double left_s = 0;
    for (std::size_t i = 0; i < leg.edges.size(); ++i) {
        all_s += leg.edges[i].segment.duration_s;
        if (i + 1 >= leg.passed_nodes) left_s += leg.edges[i].segment.duration_s;
    }
    // Pieces of a drive are counted with starts and stops of their own.
    return all_s > 0 ? leg.duration_s * left_s / all_s : 0;
}

}  // namespace

void expect_end(FleetState& fleet, const LiveVehicle& live, JobOrder& order, Time now) {
    double left_s = left_of_leg_s(live.leg());
    for (std::size_t i = static_cast<std::size_t>(live.leg().step) + 1; i < order.steps.size();
         ++i) {
        left_s += order.steps[i].planned_s;
    }
    order.expected = now + from_seconds(left_s / speed_share(live));
    fleet.store(order);
}

void renew_expected_ends(FleetState& fleet, Time now) {
    for (const JobOrderId& id : fleet.orders.open()) {
        JobOrder* order = fleet.find(id);
        if (!order->expected || *order->expected > now + kAlmostOver) continue;
        const LiveVehicle* live = fleet.find(order->assigned_vehicle);
        const bool drives = live && live->has_leg() && live->leg().order == id;
        if (drives) expect_end(fleet, *live, *order, now);
        // At its stop, or between two drives: nobody knows how long that takes.
        if (*order->expected > now + kAlmostOver) continue;
        order->expected.reset();
        fleet.store(*order);
    }
}

}  // namespace pulseline::fleet
