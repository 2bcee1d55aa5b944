#include "core/fleet/vehicle/link.hpp"

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"

namespace pulseline::fleet {
namespace {

Link link_after(Duration silent) {
    if (silent >= kGoneAfter) return Link::kGone;
    if (silent >= kLostAfter) return Link::kLost;
    if (silent >= kLateAfter) return Link::kLate;
    return Link::kLive;
}

void set_link(FleetState& fleet, VehicleRun& run, Link to, Time now) {
    if (run.link == to) return;
    add_event(fleet, now, event::kVehicleLink, {}, {}, run.record.id, {},
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
    run.delivery.reconnected();
    add_event(fleet, now, event::kVehicleConnected, {}, {}, run.record.id, {});
    hear(fleet, run, now);
    // Without order and pose, nothing tells a cut line from a vehicle that was switched off and on.
    if (run.delivery.lost()) require_person(fleet, run, {reasons::kVehicleLostOrder, {}}, now);
}

void disconnect(FleetState& fleet, VehicleRun& run, Time now) {
    if (!run.connected) return;
    run.connected = false;
    run.reconciled = false;
    add_event(fleet, now, event::kVehicleDisconnected, {}, {}, run.record.id, {});
    fleet.changed_vehicles.insert(run.record.id);
}

void update_links(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) {
        if (!run.last_heard) continue;
        const Link to = link_after(now - *run.last_heard);
        if (to == run.link) continue;
        set_link(fleet, run, to, now);
        if (to == Link::kLost && run.has_leg()) {
            require_person(fleet, run, {reasons::kVehicleWasLost, {}}, now);
        }
    }
}

}  // namespace pulseline::fleet
