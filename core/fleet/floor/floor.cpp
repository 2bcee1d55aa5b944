#include "core/fleet/floor/floor.hpp"

#include <algorithm>

#include "core/fleet/floor/closures.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

// The classes of vehicles, and who stands where.
namespace pulseline::fleet {
namespace {

using traffic::TileSet;

constexpr std::size_t kMostSwept = 256;  // segments of one leg or two

}  // namespace

TileSet floor_under(const FleetState& fleet, const VehicleRun& run, const Pose2& pose) {
    return traffic::tiles_under(hall_index(fleet, hall_of(fleet, run)), outline_at(run, pose),
                                kFloorMargin_m);
}

traffic::TileSet floor_of_edge(const FleetState& fleet, const VehicleRun& run,
                               const vda5050::OrderEdge& edge) {
    const bool loaded = is_loaded(run);
    const std::string& hall = run.leg().hall;
    for (const auto& known : run.swept) {
        if (known.segment == edge.segment && known.corridor == edge.corridor &&
            known.loaded == loaded && known.hall == hall) {
            return known.tiles;
        }
    }
    if (run.swept.size() >= kMostSwept) run.swept.clear();
    const auto floor =
        floor_along(plant::outline_with_load(*run.type, loaded), edge.segment, edge.corridor);
    run.swept.push_back({edge.segment, edge.corridor, loaded, hall,
                         traffic::tiles_under(hall_index(fleet, hall), floor, kFloorMargin_m)});
    return run.swept.back().tiles;
}

traffic::TileSet floor_at_node(const FleetState& fleet, const VehicleRun& run, std::size_t i) {
    const Leg& leg = run.leg();
    const auto under = floor_under(fleet, run, leg.nodes[i].pose);
    if (i == 0 || i >= leg.edges.size()) return under;
    const vda5050::OrderEdge& next = leg.edges[i];
    const auto room = room_between(leg.edges[i - 1].segment, leg.edges[i - 1].corridor,
                                   next.segment, next.corridor);
    if (!room) return under;
    const auto about =
        room_about(plant::outline_with_load(*run.type, is_loaded(run)), next.segment, *room);
    return traffic::merge(
        under, traffic::tiles_under(hall_index(fleet, leg.hall), {about}, kFloorMargin_m));
}

/// An aircraft is moved aside last, and so is who waits to begin a drive of its own.
traffic::Leaves leaves(const FleetState& fleet, const VehicleRun& run) {
    if (const JobOrder* order = fleet.orders.of(run.record.id)) {
        const bool waits = order->state == JobState::kRunning && !run.has_leg();
        return waits ? traffic::Leaves::kLast : traffic::Leaves::kNever;
    }
    if (charges_on(run)) return traffic::Leaves::kNever;
    return is_loaded(run) ? traffic::Leaves::kLast : traffic::Leaves::kFirst;
}

void halt_or_resume(FleetState& fleet, VehicleRun& run, Time now) {
    fleet.floor.traffic.set_leaves(run.floor.vehicle, leaves(fleet, run));
    const bool can_move = !run.floor.conflict && run.floor.pose && !cannot_move(fleet, run);
    if (can_move) {
        fleet.floor.traffic.resume(run.floor.vehicle, now);
    } else {
        fleet.floor.traffic.halt(run.floor.vehicle, now);
    }
}

Reason floor_reason(const FleetState& fleet, const traffic::Block& block) {
    Reason reason = fleet.floor.traffic.reason_of(block);
    if (block.cause == traffic::BlockCause::kVehicle) {
        reason.code = "floor_held";
        std::erase_if(reason.params, [](const Param& p) { return p.name == "by"; });
    } else if (block.cause == traffic::BlockCause::kClosed) {
        reason.code = "floor_closed";
        std::erase_if(reason.params, [](const Param& p) { return p.name == "by"; });
        if (const Closure* closure = block.tile ? closure_at(fleet, *block.tile) : nullptr) {
            name_closures(fleet, {closure->id.str()}, reason);
        }
    }
    return reason;
}

std::optional<Reason> floor_wait(const FleetState& fleet, const VehicleRun& run) {
    if (fleet.floor.stopped) return fleet.floor.stopped;
    if (run.floor.conflict) return run.floor.conflict;
    const auto waits = fleet.floor.traffic.waits_of(run.floor.vehicle);
    if (waits.empty()) {
        if (fleet.floor.traffic.postponed(run.floor.vehicle)) {
            const auto block = fleet.floor.traffic.blocked_by(run.floor.vehicle);
            return block ? floor_reason(fleet, *block)
                         : Reason{"gives_way", {{"vehicle", run.record.id.str()}}};
        }
        return std::nullopt;
    }
    return floor_reason(fleet, waits.front().block);
}

const FloorClass& floor_class_of(const FleetState& fleet, const VehicleRun& run) {
    return fleet.floor.classes[run.floor.of_class];
}

traffic::MoveNumber move_of_node(const VehicleRun& run, std::size_t node) {
    return static_cast<traffic::MoveNumber>(run.floor.moves_before_leg +
                                            static_cast<std::int64_t>(node));
}

}  // namespace pulseline::fleet
