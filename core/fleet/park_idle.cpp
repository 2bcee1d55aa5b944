#include <set>

#include "core/fleet/dispatch_phases.hpp"

namespace pulseline::fleet {
namespace {

// An order that comes soon after a stop finds the vehicle still there.
constexpr Duration kParkAfter = std::chrono::seconds(10);

std::set<traffic::VehicleIndex> waited_for(const FleetState& fleet) {
    std::set<traffic::VehicleIndex> found;
    for (const auto& wait : fleet.floor.traffic.waits()) {
        if (wait.block.cause == traffic::BlockCause::kVehicle) found.insert(wait.block.vehicle);
    }
    return found;
}

plant::StationId last_station(const FleetState& fleet, const VehicleRun& run) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    const auto place = plan.place_after(plan.last());
    if (place == traffic::kNoPlace) return {};
    return fleet.floor.classes[run.floor.of_class].motion.places[place].station;
}

void leave(FleetState& fleet, VehicleRun& run, const plant::StationId& station, Time now) {
    Leg leg;
    leg.id = LegId(fleet.ids.next(now));
    leg.vehicle = run.record.id;
    leg.station = station;
    leg.mode = plant::MotionMode::kLinear;
    leg.hall = hall_of(fleet, run);
    leg.nodes.push_back(start_node(run.record.pose, leg.hall));
    const auto idle_since = run.floor.idle_since;
    take_leg(run, std::move(leg));
    run.floor.idle_since = idle_since;
    take_plan_as_leg(fleet, run);
    fleet.store(run);
    add_event(fleet, now, "vehicle.makes_way", {}, run.leg().id, run.record.id, {},
              {{"station", station.str()}});
    extend_base(fleet, run, now);
}

}  // namespace

void park_idle(FleetState& fleet, Time now) {
    std::optional<std::set<traffic::VehicleIndex>> wanted_away;
    for (auto& [id, run] : fleet.vehicles) {
        const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
        // An order whose own way is barred does not keep its vehicle from making way meanwhile.
        const bool waits = !fleet.orders.of(id) || run.floor.next_try;
        const bool idle = !run.has_leg() && waits && plan.last() > plan.passed;
        if (!idle || cannot_move(fleet, run) || not_ready(fleet, run, now)) {
            if (!idle) run.floor.idle_since.reset();
            continue;
        }
        if (!run.floor.idle_since) run.floor.idle_since = now;
        if (now - *run.floor.idle_since < kParkAfter) {
            if (!wanted_away) wanted_away = waited_for(fleet);
            if (wanted_away->count(run.floor.vehicle) == 0) continue;
        }
        const auto station = last_station(fleet, run);
        if (station.empty() || ends_charging(fleet, run, now)) continue;
        leave(fleet, run, station, now);
    }
}

}  // namespace pulseline::fleet
