#include "core/fleet/vehicle/link.hpp"

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/lifts.hpp"

namespace pulseline::fleet {
namespace {

Link link_after(Duration silent) {
    if (silent >= kGoneAfter) return Link::kGone;
    if (silent >= kLostAfter) return Link::kLost;
    if (silent >= kLateAfter) return Link::kLate;
    return Link::kLive;
}

void set_link(FleetState& fleet, LiveVehicle& live, Link to, Time now) {
    if (live.link == to) return;
    add_event(fleet, now, event::kVehicleLink, {}, {}, live.record.id, {},
              {{"from", to_string(live.link)}, {"to", to_string(to)}});
    live.link = to;
    fleet.changed_vehicles.insert(live.record.id);
}

}  // namespace

void note_heard(FleetState& fleet, LiveVehicle& live, Time now) {
    live.last_heard = now;
    set_link(fleet, live, Link::kLive, now);
}

void connect(FleetState& fleet, LiveVehicle& live, Time now) {
    give_up_lift(fleet, live, now);  // of a line that nobody saw break
    live.connected = true;
    live.reconciled = false;
    live.newest_header = 0;
    live.delivery.reconnected();
    add_event(fleet, now, event::kVehicleConnected, {}, {}, live.record.id, {});
    note_heard(fleet, live, now);
    // Without order and pose, nothing tells a cut line from a vehicle that was switched off and on.
    if (live.delivery.lost()) require_person(fleet, live, {reasons::kVehicleLostOrder, {}}, now);
}

void disconnect(FleetState& fleet, LiveVehicle& live, Time now) {
    if (!live.connected) return;
    give_up_lift(fleet, live, now);
    live.connected = false;
    live.reconciled = false;
    add_event(fleet, now, event::kVehicleDisconnected, {}, {}, live.record.id, {});
    fleet.changed_vehicles.insert(live.record.id);
}

void update_links(FleetState& fleet, Time now) {
    for (auto& [id, live] : fleet.vehicles) {
        if (!live.last_heard) continue;
        const Link to = link_after(now - *live.last_heard);
        if (to == live.link) continue;
        set_link(fleet, live, to, now);
        if (to == Link::kLost) give_up_lift(fleet, live, now);
        if (to == Link::kLost && live.has_leg()) {
            require_person(fleet, live, {reasons::kVehicleWasLost, {}}, now);
        }
    }
}

}  // namespace pulseline::fleet
