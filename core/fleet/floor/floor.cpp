#include "core/fleet/floor/floor.hpp"

#include <algorithm>

#include "core/fleet/floor/closures.hpp"
#include "core/fleet/floor/standing_loads.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/tables/plant_tables.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

// The classes of vehicles, and who stands where.
namespace pulseline::fleet {
namespace {

using traffic::TileSet;

constexpr std::size_t kMostSwept = 256;  // segments of one leg or two

}  // namespace

TileSet floor_under(const FleetState& fleet, const LiveVehicle& live, const Pose2& pose) {
    return tiles_of_body(fleet.tables->overhead, hall_index(fleet, hall_of(fleet, live)),
                         outline_at(live, pose), kFloorMargin_m, is_loaded(live));
}

traffic::TileSet floor_of_edge(const FleetState& fleet, const LiveVehicle& live,
                               const vda5050::OrderEdge& edge) {
    const bool loaded = is_loaded(live);
    const std::string& hall = live.leg().hall;
    for (const auto& known : live.swept) {
        if (known.segment == edge.segment && known.corridor == edge.corridor &&
            known.loaded == loaded && known.hall == hall) {
            return known.tiles;
        }
    }
    if (live.swept.size() >= kMostSwept) live.swept.clear();
    const auto floor =
        floor_along(plant::outline_with_load(*live.type, loaded), edge.segment, edge.corridor);
    live.swept.push_back({edge.segment, edge.corridor, loaded, hall,
                          tiles_of_body(fleet.tables->overhead, hall_index(fleet, hall), floor,
                                        kFloorMargin_m, loaded)});
    return live.swept.back().tiles;
}

traffic::TileSet floor_at_node(const FleetState& fleet, const LiveVehicle& live, std::size_t i) {
    const Leg& leg = live.leg();
    const auto under = floor_under(fleet, live, leg.nodes[i].pose);
    if (i == 0 || i >= leg.edges.size()) return under;
    const vda5050::OrderEdge& next = leg.edges[i];
    const auto room = room_between(leg.edges[i - 1].segment, leg.edges[i - 1].corridor,
                                   next.segment, next.corridor);
    if (!room) return under;
    const auto about =
        room_about(plant::outline_with_load(*live.type, is_loaded(live)), next.segment, *room);
    return traffic::merge(under, tiles_of_body(fleet.tables->overhead, hall_index(fleet, leg.hall),
                                               {about}, kFloorMargin_m, is_loaded(live)));
}

/// An aircraft is moved aside last, and so is who waits to begin a drive of its own.
traffic::Leaves leaves(const FleetState& fleet, const LiveVehicle& live) {
    if (const JobOrder* order = fleet.orders.of(live.record.id)) {
        const bool waits = order->state == JobState::kRunning && !live.has_leg();
        return waits ? traffic::Leaves::kLast : traffic::Leaves::kNever;
    }
    if (charges_on(live)) return traffic::Leaves::kNever;
    return is_loaded(live) ? traffic::Leaves::kLast : traffic::Leaves::kFirst;
}

void halt_or_resume(FleetState& fleet, LiveVehicle& live, Time now) {
    fleet.floor.traffic.set_leaves(live.floor.vehicle, leaves(fleet, live));
    const bool can_move = !live.floor.conflict && live.floor.pose && !cannot_move(fleet, live);
    if (can_move) {
        fleet.floor.traffic.resume(live.floor.vehicle, now);
    } else {
        fleet.floor.traffic.halt(live.floor.vehicle, now);
    }
}

Reason floor_reason(const FleetState& fleet, const traffic::Block& block) {
    Reason reason = fleet.floor.traffic.reason_of(block);
    if (block.cause == traffic::BlockCause::kVehicle) {
        reason.code = "floor_held";
        std::erase_if(reason.params, [](const Param& p) { return p.name == "by"; });
    } else if (block.cause == traffic::BlockCause::kClosed) {
        const auto* load = block.tile ? standing_load_at(fleet, *block.tile) : nullptr;
        if (load) return load_in_the_way(fleet, *load);
        reason.code = reasons::kFloorClosed;
        std::erase_if(reason.params, [](const Param& p) { return p.name == "by"; });
        if (const Closure* closure = block.tile ? closure_at(fleet, *block.tile) : nullptr) {
            name_closures(fleet, {closure->id.str()}, reason);
        }
    }
    return reason;
}

std::optional<Reason> floor_wait(const FleetState& fleet, const LiveVehicle& live) {
    if (fleet.floor.stopped) return fleet.floor.stopped;
    if (live.floor.conflict) return live.floor.conflict;
    const auto waits = fleet.floor.traffic.waits_of(live.floor.vehicle);
    if (waits.empty()) {
        if (fleet.floor.traffic.postponed(live.floor.vehicle)) {
            const auto block = fleet.floor.traffic.blocked_by(live.floor.vehicle);
            return block ? floor_reason(fleet, *block)
                         : Reason{"gives_way", {{"vehicle", live.record.id.str()}}};
        }
        return std::nullopt;
    }
    return floor_reason(fleet, waits.front().block);
}

const FloorClass& floor_class_of(const FleetState& fleet, const LiveVehicle& live) {
    return fleet.floor.classes[live.floor.of_class];
}

traffic::MoveNumber move_of_node(const LiveVehicle& live, std::size_t node) {
    return static_cast<traffic::MoveNumber>(live.floor.moves_before_leg +
                                            static_cast<std::int64_t>(node));
}

}  // namespace pulseline::fleet
