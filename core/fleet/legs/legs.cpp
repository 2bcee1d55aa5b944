#include "core/fleet/legs/legs.hpp"

#include <cmath>

#include "core/fleet/floor/admission.hpp"
#include "core/fleet/floor/floor.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/legs/expected_end.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/sending.hpp"

namespace pulseline::fleet {
namespace {

// Time from "node passed" on the vehicle to the extended base being there: report interval, tick,
// commit and link, with reserve.
constexpr double kExtendLatency_s = 0.5;

/// Barred where it may leave its line, it asks for more of the lane to go round what stands there.
bool wants_room(const LiveVehicle& live) {
    const Leg& leg = live.leg();
    return live.state.field_violation && live.state.new_base_request &&
           leg.edges[leg.released_nodes - 1].corridor.has_value();
}

/// Standing at the end of its base, it waits for somebody; still driving, it does not.
void tell_wait(FleetState& fleet, LiveVehicle& live, Time now) {
    if (live.leg().passed_nodes < live.leg().released_nodes) return;
    JobOrder* order = fleet.find(live.leg().order);
    if (!order || order->state != JobState::kRunning) return;
    const auto wait = floor_wait(fleet, live);
    if (!wait) return;
    set_order_reason(fleet, *order, *wait, now);
    fleet.changed_vehicles.insert(live.record.id);
}

}  // namespace

void take_leg(LiveVehicle& live, Leg leg) {
    live.record.has_leg = true;
    live.record.leg = leg.id;
    live.record.leg_data = std::move(leg);
    live.delivery.begin();
    live.floor.idle_since.reset();
}

std::optional<Reason> try_leg(FleetState& fleet, LiveVehicle& live, Leg leg, Time now) {
    const VehicleRecord before = live.record;
    const auto idle_since = live.floor.idle_since;
    take_leg(live, std::move(leg));
    if (live.leg().nodes.size() == 1) return std::nullopt;
    auto reason = plan_on_floor(fleet, live, now);
    if (reason) {
        live.record = before;
        live.floor.idle_since = idle_since;
    }
    return reason;
}

void send_leg(FleetState& fleet, LiveVehicle& live, Time now) {
    if (live.leg().nodes.size() == 1) {
        send_order_update(fleet, live, 0, now);
    } else {
        extend_base(fleet, live, now);
    }
}

void extend_base(FleetState& fleet, LiveVehicle& live, Time now) {
    follow_replans(fleet, now);  // what is released has to be what the plan has now
    Leg& leg = live.leg();
    if (live.delivery.cancelling()) return;
    if (leg.released_nodes >= leg.nodes.size()) {
        // With the stop in its base it waits for nobody.
        if (leg.nodes.back().actions.empty()) tell_wait(fleet, live, now);
        return;
    }
    const double speed = speed_of(live);
    const double wanted_m = speed * speed / (2 * accel_of(live)) + speed * kExtendLatency_s;
    double ahead_m = -live.state.distance_since_last_node_m;
    for (std::size_t i = leg.passed_nodes; i < leg.released_nodes; ++i) {
        ahead_m += std::abs(leg.edges[i - 1].segment.length_m);
    }
    std::size_t wanted = leg.released_nodes;
    const std::size_t least = wanted + (wants_room(live) ? 1 : 0);
    while (wanted < leg.nodes.size() && (wanted == 1 || wanted < least || ahead_m < wanted_m)) {
        // A turn on the spot ends standing anyway: released with the move behind it.
        ahead_m += std::abs(leg.edges[wanted - 1].segment.length_m);
        ++wanted;
    }
    const std::size_t before = leg.released_nodes;
    if (wanted == before) return;
    const std::size_t granted = grant_nodes(fleet, live, wanted - 1, now);
    if (granted == before) return tell_wait(fleet, live, now);
    for (std::size_t i = before; i < granted; ++i) {
        leg.edges[i - 1].released = true;
        leg.nodes[i].released = true;
    }
    leg.released_nodes = granted;
    JobOrder* order = fleet.find(leg.order);
    if (order && order->state == JobState::kRunning) {
        set_order_reason(fleet, *order, {}, now);
        if (!order->expected && live.delivery.seen()) expect_end(fleet, live, *order, now);
    }
    const bool is_new = before == 1 && live.delivery.phase() == LegDelivery::Phase::kPlanned;
    if (!is_new) ++leg.update_id;
    send_order_update(fleet, live, is_new ? 0 : before - 1, now);
    add_event(fleet, now, event::kLegReleased, leg.order, leg.id, leg.vehicle, {},
              {{"nodes", static_cast<std::int64_t>(leg.released_nodes)},
               {"of", static_cast<std::int64_t>(leg.nodes.size())},
               {"update", leg.update_id}});
    fleet.store(live);
}

}  // namespace pulseline::fleet
