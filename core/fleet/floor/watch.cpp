#include "core/fleet/floor/watch.hpp"

#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/tables/plant_tables.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

// The fleet's own doubt about traffic: every change goes to the independent monitor before it is
// sent, and what the monitor objects to stops all of it.
namespace pulseline::fleet {
namespace {

constexpr Duration kCheckEvery = std::chrono::seconds(1);

/// Nothing is granted any more.
void stop_floor(FleetState& fleet, const traffic::Violation& violation, Time now) {
    fleet.floor.stopped = Reason{"traffic_violation", {{"violation", to_string(violation)}}};
    add_event(fleet, now, event::kTrafficViolation, {}, {}, {}, {}, fleet.floor.stopped->params);
}

}  // namespace

bool keeps_to_its_floor(FleetState& fleet, const LiveVehicle& live, std::size_t nodes, Time now) {
    const Leg& leg = live.leg();
    const auto body = plant::outline_with_load(*live.type, is_loaded(live));
    for (std::size_t i = leg.released_nodes; i < nodes; ++i) {
        const vda5050::OrderEdge& edge = leg.edges[i - 1];
        const auto under =
            tiles_of_body(fleet.tables->overhead, hall_index(fleet, leg.hall),
                          floor_along(body, edge.segment, edge.corridor), 0, is_loaded(live));
        const auto outside = fleet.floor.monitor.check_footprint(live.floor.vehicle, under);
        if (outside.empty()) continue;
        stop_floor(fleet, outside.front(), now);
        return false;
    }
    return true;
}

bool floor_is_sound(FleetState& fleet, Time now) {
    Floor& floor = fleet.floor;
    const auto violations = floor.monitor.apply(floor.traffic.take_changes());
    if (violations.empty() || floor.stopped) return !floor.stopped;
    stop_floor(fleet, violations.front(), now);
    return false;
}

void check_whole_floor(FleetState& fleet, Time now) {
    Floor& floor = fleet.floor;
    if (floor.checked && now - *floor.checked < kCheckEvery) return;
    floor.checked = now;
    if (!floor_is_sound(fleet, now)) return;
    if (!floor.monitor.take_changed()) return;
    const auto violations = floor.monitor.check_all();
    if (!violations.empty()) stop_floor(fleet, violations.front(), now);
}

}  // namespace pulseline::fleet
