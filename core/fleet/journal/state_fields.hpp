#pragma once

#include "core/fleet/state/fields.hpp"
#include "core/fleet/state/fleet_state.hpp"

/// The fleet's own state, described as in fields.hpp. Not for use outside core/fleet.
namespace pulseline {

PULSELINE_LAST(traffic::BlockCause, kHalted)
PULSELINE_LAST(traffic::Leaves, kFirst)

namespace traffic {
PULSELINE_FIELDS(MoveRef, vehicle, move)
PULSELINE_FIELDS(Visit, place, dwell_s)
PULSELINE_FIELDS(Block, cause, vehicle, move, tile)
PULSELINE_FIELDS(Use, vehicle, first, last)
PULSELINE_FIELDS(Sequence::Step, swept, stand, duration_s, its_visit, place)
PULSELINE_FIELDS(Sequence, steps, ends_at)
PULSELINE_FIELDS(Task, visits, resting, sequences, may_delay_others, asks_to_leave, later, purpose,
                 since_s)
PULSELINE_FIELDS(Shape, swept, stand)
PULSELINE_FIELDS(VehiclePlan, stand, place, passed, released, dropped, moves, since_s, halted)

// Stamp and openness are a prediction's own notes.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, PlannedMove>
void fields(V& visitor, S& it) {
    auto& [shape, place, visit, duration_s, start_s, end_s, waits_for, stamp, open] = it;
    visitor(shape, place, visit, duration_s, start_s, end_s, waits_for);
}

inline void write(fleet::journal::Writer& out, const ShapePtr& shape) { out.put(*shape); }
inline void read(fleet::journal::Reader& in, ShapePtr& shape) {
    auto made = std::make_shared<Shape>();
    in.get(*made);
    shape = std::move(made);
}

/// Most tiles have nobody in their queue: only the others, each behind its distance to the one
/// before.
inline void write(fleet::journal::Writer& out, const std::vector<std::vector<Use>>& queues) {
    out.number(queues.size());
    std::size_t next = 0;
    for (std::size_t tile = 0; tile < queues.size(); ++tile) {
        if (queues[tile].empty()) continue;
        out.number(tile - next + 1);
        out.put(queues[tile]);
        next = tile + 1;
    }
    out.number(0);
}
constexpr std::uint64_t kMostTiles = 1U << 26;  // of 0.5 m: 16 square kilometres
inline void read(fleet::journal::Reader& in, std::vector<std::vector<Use>>& queues) {
    const std::uint64_t size = in.number();
    if (size > kMostTiles) return in.refuse("too many tiles");
    queues.assign(size, {});
    std::uint64_t next = 0;
    for (std::uint64_t step = in.number(); step != 0; step = in.number()) {
        if (step > size - next) return in.refuse("a tile beyond the last");
        next += step;
        in.get(queues[next - 1]);
    }
}

}  // namespace traffic

namespace fleet {

PULSELINE_FIELDS(PendingAction, action, first_sent, last_sent, sends, escalated)
PULSELINE_FIELDS(FloorStand, of_class, vehicle, moves_before_leg, leg_planned, pose, conflict,
                 next_try, in_vain_since, next_leave, idle_since)
PULSELINE_FIELDS(LiveVehicle::Seen, pose, at, moving, speed_mps)
PULSELINE_FIELDS(LiveVehicle::Statement, where, at, actor)
PULSELINE_FIELDS(FleetState::ClosedFloor, closure, tiles, in_traffic)
PULSELINE_FIELDS(StandingLoad, load, room, in_traffic)

PULSELINE_FIELDS(AwaitedPlan, question, request, asked, answer)

// Vehicle, type and load are the plant's; the areas are only drawn. Areas, plan and swept floor are
// worked out when asked for and not there, and come out the same.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, LiveVehicle>
void fields(V& visit, S& it) {
    auto& [vehicle, type, record, connected, reconciled, connection_refused, link, last_heard,
           state, state_at, newest_header, factsheet, delivery, floor, seen, seen_before, stated,
           claim_told, claim_left, foreign_since, actions, errors_from, errors_told, charge_wait,
           charge_retry, made_way, lift, load, areas, leg_markers, awaited_plan, newest_plan,
           swept] = it;
    auto& leg = delivery.all();
    visit(record, connected, reconciled, connection_refused, link, last_heard, state, state_at,
          newest_header, factsheet, leg.seen, leg.sent_from, leg.unconfirmed_since, leg.sends,
          leg.on_this_connection, leg.lost, leg.cancelling, floor, seen, seen_before, stated,
          claim_told, claim_left, leg.started, foreign_since, actions, errors_from, errors_told,
          charge_wait, charge_retry, made_way, lift, awaited_plan);
}

// The monitor is told all that traffic knows; the classes come from the plant.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, Floor>
void fields(V& visit, S& it) {
    auto& [its_traffic, monitor, classes, stopped, improved, checked, standing_loads, loads_moved] =
        it;
    visit(its_traffic, stopped, improved, checked, standing_loads);
}

/// All but plant, planner and vehicles, which snapshot.cpp puts together, and what a step puts out,
/// which has been taken.
template <class V, class S>
requires std::same_as<std::remove_const_t<S>, FleetState>
void fields(V& visit, S& it) {
    auto& [its_plant, tables, planner, ids, started, vehicles, load_sheets, loads, orders,
           idempotency, floor, closures, keys_swept, event_seq, order_number, questions, standing,
           stored_seq, store_fault, clock_difference, out, stored_vehicles, stored_orders,
           stored_loads, stored_load_sheets, changed_vehicles, changed_stations, plans_wanted] = it;
    visit(ids, started, load_sheets, loads, orders, idempotency, floor, closures, keys_swept,
          event_seq, order_number, questions, standing, stored_seq, store_fault, clock_difference);
}

}  // namespace fleet
}  // namespace pulseline
