#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fleet/floor.hpp"
#include "core/fleet/state.hpp"
#include "core/kinematics/primitives.hpp"

// Legs in the joint plan: admission, horizon, grants, passing.
namespace pulseline::fleet {
namespace {

using traffic::kNoPlace;
using traffic::kNoVisit;
using traffic::MoveNumber;

constexpr double kStop_s = 20;  // predicted time of a correction and its measurement
// Work on what a vehicle has brought takes until somebody needs the floor; so long at least it is
// predicted to stay, so that plans of others come before its leaving.
constexpr double kWork_s = 900;
constexpr traffic::VisitIndex kWork = 1;  // the visit behind the stop
constexpr double kSamePose_m = 1e-3;
constexpr double kSamePose_rad = 1e-3;
constexpr Duration kRetry = std::chrono::seconds(1);  // of a barred admission: it is a search
constexpr Duration kImproveEvery = std::chrono::seconds(1);
constexpr int kImproveSteps = 4;
constexpr std::size_t kMostSwept = 256;  // segments of one leg or two

const FloorClass& class_of(const FleetState& fleet, const VehicleRun& run) {
    return fleet.floor.classes[run.floor.of_class];
}

bool same_pose(const Pose2& a, const Pose2& b) {
    return geometry::distance(a.position(), b.position()) < kSamePose_m &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) < kSamePose_rad;
}

/// It brings its load to where it cannot rest: it stays there until others need the floor.
bool works_at(const VehicleRun& run, const plant::Station& station) {
    return is_loaded(run) && !station.resting_place;
}

/// What the leg's task is part of, and where the order goes on to.
void describe_order(const FleetState& fleet, const VehicleRun& run, const JobOrder& order,
                    traffic::Task& task) {
    task.purpose = static_cast<std::uint64_t>(order.number);
    task.since_s = seconds(order.created.time_since_epoch());
    for (std::size_t i = order.current_step + 1; i < order.steps.size(); ++i) {
        const auto place = class_of(fleet, run).motion.station_place(order.steps[i].station);
        if (place) task.later.push_back(static_cast<traffic::PlaceIndex>(*place));
    }
}

/// Nobody has asked for the leg's mode of motion, or it leads by the roads anyway.
bool may_take_any_way(const FleetState& fleet, const Leg& leg) {
    if (leg.mode == plant::MotionMode::kLinear) return true;
    const JobOrder* order = fleet.find(leg.order);
    const auto step = static_cast<std::size_t>(leg.step);
    return order && step < order->steps.size() &&
           order->steps[step].mode == plant::MotionMode::kAuto;
}

/// The place whose pose it is but for rounding.
traffic::PlaceIndex exact_place(const FloorClass& of_class, const std::string& hall,
                                const Pose2& pose) {
    const auto place = of_class.motion.place_at(plant::HallId(hall), pose);
    return place && same_pose(of_class.motion.places[*place].pose, pose)
               ? static_cast<traffic::PlaceIndex>(*place)
               : kNoPlace;
}

MoveNumber move_of_node(const VehicleRun& run, std::size_t node) {
    return static_cast<MoveNumber>(run.floor.moves_before_leg + static_cast<std::int64_t>(node));
}

/// The leg's edges behind its base as traffic takes them.
traffic::Sequence sequence_of(const FleetState& fleet, const VehicleRun& run) {
    const Leg& leg = run.leg();
    const FloorClass& of_class = class_of(fleet, run);
    traffic::Sequence sequence;
    for (std::size_t i = leg.released_nodes; i < leg.nodes.size(); ++i) {
        traffic::Sequence::Step step;
        step.swept = floor_of_edge(fleet, run, leg.edges[i - 1]);
        step.place = exact_place(of_class, leg.hall, leg.nodes[i].pose);
        step.stand =
            step.place != kNoPlace ? of_class.stands[step.place] : floor_at_node(fleet, run, i);
        step.duration_s = std::max(0.1, leg.edges[i - 1].segment.duration_s);
        sequence.steps.push_back(std::move(step));
    }
    return sequence;
}

OrderNode horizon_node(const Leg& leg, const Pose2& pose) {
    OrderNode node;
    const std::size_t index = leg.nodes.size();
    node.node_id = "p" + std::to_string(index);
    node.sequence_id = static_cast<std::int64_t>(2 * index);
    node.pose = pose;
    node.map_id = leg.hall;
    return node;
}

OrderEdge horizon_edge(const Leg& leg, kinematics::Segment segment) {
    OrderEdge edge;
    const std::size_t index = leg.nodes.size();
    edge.edge_id = "e" + std::to_string(index);
    edge.sequence_id = static_cast<std::int64_t>(2 * index - 1);
    edge.segment = std::move(segment);
    return edge;
}

/// One more move of the plan at the end of the leg. A straight keeps the heading the vehicle was
/// measured at; the last turn or the correction at the stop takes the rest away.
void append_move(const FloorClass& of_class, Leg& leg, traffic::PlaceIndex place,
                 std::optional<traffic::PlaceIndex> from) {
    const Pose2 here = leg.nodes.back().pose;
    const Pose2& there = of_class.motion.places[place].pose;
    std::vector<kinematics::Segment> segments;
    if (geometry::distance(here.position(), there.position()) <= planning::kAtPlace_m) {
        kinematics::append_turn(segments, here,
                                kinematics::shortest_turn_rad(here.heading_rad, there.heading_rad));
    } else {
        kinematics::append_straight(segments, here, there.position());
    }
    kinematics::Segment segment;
    segment.start = segment.end = here;
    if (!segments.empty()) segment = segments.front();
    if (segments.size() > 1) {  // half a turn comes as two places; rounding must not make it three
        segment.end = segments.back().end;
        segment.turn_rad += segments.back().turn_rad;
    }
    OrderEdge edge = horizon_edge(leg, std::move(segment));
    if (from) {
        const auto way = of_class.way_between.find({*from, place});
        if (way != of_class.way_between.end()) {
            edge.max_speed_mps = of_class.motion.ways[way->second].max_speed_mps;
            edge.segment.duration_s = of_class.motion.ways[way->second].duration_s;
            edge.corridor = of_class.corridors[way->second];
        }
    }
    leg.nodes.push_back(horizon_node(leg, edge.segment.end));
    leg.edges.push_back(std::move(edge));
}

/// Makes the leg's horizon that of the plan; true when it changed.
bool take_horizon(FleetState& fleet, VehicleRun& run) {
    Leg& leg = run.leg();
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    const FloorClass& of_class = class_of(fleet, run);
    // The stop is in the base: the vehicle makes it, whatever the plan would do before.
    if (leg.released_nodes == leg.nodes.size() && !leg.nodes.back().actions.empty()) return false;
    const auto is_drive = [&](MoveNumber n) {
        return n <= plan.last() && plan.at(n).visit == kNoVisit;
    };
    std::size_t node = leg.released_nodes;
    for (; node < leg.nodes.size() && is_drive(move_of_node(run, node)); ++node) {
        const auto& move = plan.at(move_of_node(run, node));
        // Without a place it is the leg's own step: those never come from a search.
        if (move.place == kNoPlace) continue;
        if (!same_pose(of_class.motion.places[move.place].pose, leg.nodes[node].pose)) break;
    }
    const bool ends = !is_drive(move_of_node(run, node));
    const bool has_stop = move_of_node(run, node) <= plan.last() && ends;
    if (node == leg.nodes.size() && ends &&
        (leg.order.empty() || has_stop == !leg.nodes.back().actions.empty())) {
        return false;
    }
    leg.nodes.resize(node);
    leg.edges.resize(node - 1);
    run.areas = {};  // they are of the old horizon
    // What was the stop may only be passed now, and is stopped at later.
    for (std::size_t i = leg.released_nodes; i < node; ++i) {
        if (leg.nodes[i].actions.empty()) continue;
        leg.nodes[i].actions.clear();
        leg.nodes[i].node_id = "p" + std::to_string(i);
    }
    MoveNumber next = move_of_node(run, node);
    for (; is_drive(next); ++next) {
        const MoveNumber n = next;
        const traffic::PlaceIndex before = plan.place_after(n - 1);
        append_move(of_class, leg, plan.at(n).place,
                    before == kNoPlace ? std::nullopt : std::optional(before));
    }
    if (leg.order.empty()) {
        // Making way ends wherever the plan found a resting place this time.
        const auto end = plan.place_after(plan.last());
        const bool at_station = end != kNoPlace && !of_class.motion.places[end].station.empty();
        if (at_station) leg.station = of_class.motion.places[end].station;
    }
    const auto* station = plant::find_station(fleet.plant, leg.station);
    const bool stops = next <= plan.last();
    const bool rests = leg.order.empty() && station && leg.nodes.size() > 1;
    if (stops || rests) {
        leg.nodes.back().node_id = station->id.str();
        leg.nodes.back().actions = leg.order.empty() ? rest_actions(fleet, run, *station, leg)
                                                     : stop_actions(fleet, run, *station, leg.id);
    }
    widen_nodes(leg);
    leg.duration_s = 0;
    for (const auto& edge : leg.edges) leg.duration_s += edge.segment.duration_s;
    return true;
}

}  // namespace

traffic::TileSet floor_of_edge(const FleetState& fleet, const VehicleRun& run,
                               const OrderEdge& edge) {
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
    const OrderEdge& next = leg.edges[i];
    const auto room = room_between(leg.edges[i - 1].segment, leg.edges[i - 1].corridor,
                                   next.segment, next.corridor);
    if (!room) return under;
    const auto about =
        room_about(plant::outline_with_load(*run.type, is_loaded(run)), next.segment, *room);
    return traffic::merge(
        under, traffic::tiles_under(hall_index(fleet, leg.hall), {about}, kFloorMargin_m));
}

void widen_nodes(Leg& leg) {
    for (std::size_t i = std::max<std::size_t>(1, leg.released_nodes); i < leg.edges.size(); ++i) {
        const OrderEdge& edge = leg.edges[i - 1];
        const OrderEdge& next = leg.edges[i];
        const auto room = room_between(edge.segment, edge.corridor, next.segment, next.corridor);
        leg.nodes[i].allowed_deviation_xy_m = room && leg.nodes[i].actions.empty()
                                                  ? std::max(room->left_m, room->right_m)
                                                  : OrderNode{}.allowed_deviation_xy_m;
    }
}

std::optional<Reason> plan_on_floor(FleetState& fleet, VehicleRun& run, Time now) {
    auto& traffic = fleet.floor.traffic;
    auto& stand = run.floor;
    if (stand.conflict) return stand.conflict;
    if (fleet.floor.stopped) return fleet.floor.stopped;
    Leg& leg = run.leg();
    const auto target = class_of(fleet, run).motion.station_place(leg.station);
    if (!target) return Reason{"station_not_for_type", {{"station", leg.station.str()}}};
    const auto& plan = traffic.plan(stand.vehicle);
    if (!stand.leg_planned && leg.released_nodes <= 1) {
        stand.moves_before_leg = static_cast<std::int64_t>(plan.passed);
    }
    traffic::Task task;
    const auto goal = static_cast<traffic::PlaceIndex>(*target);
    if (leg.order.empty()) {
        task.resting = {goal};  // it makes way: no stop to make
    } else {
        task.visits = {{goal, kStop_s}};
        const auto* station = plant::find_station(fleet.plant, leg.station);
        if (station && works_at(run, *station)) task.visits.push_back({goal, kWork_s});
        if (const auto* order = fleet.find(leg.order)) describe_order(fleet, run, *order, task);
    }
    auto sequence = sequence_of(fleet, run);
    if (!sequence.steps.empty()) {
        // A horizon of before a restart may lead elsewhere, to give way: the search goes on there.
        const auto end =
            class_of(fleet, run).motion.place_at(plant::HallId(leg.hall), leg.nodes.back().pose);
        sequence.ends_at = end ? static_cast<traffic::PlaceIndex>(*end) : kNoPlace;
        if (end) task.sequences = {std::move(sequence)};
    }
    const bool on_roads =
        plan.place_after(plan.released) != kNoPlace && may_take_any_way(fleet, leg);
    const auto admit = [&] {
        if (!on_roads || task.sequences.empty()) return traffic.admit(stand.vehicle, task, now);
        // Nobody has to leave for a short cut, and where that has no end of waiting any other way
        // is better.
        traffic::Task short_cut = task;
        short_cut.asks_to_leave = false;
        if (auto taken = traffic.admit(stand.vehicle, short_cut, now)) return taken;
        traffic::Task by_roads = task;
        by_roads.sequences.clear();
        auto elsewhere = traffic.admit(stand.vehicle, by_roads, now);
        if (elsewhere) leg.mode = plant::MotionMode::kLinear;
        const auto block = traffic.blocked_by(stand.vehicle);
        const bool none = !elsewhere && block && block->cause == traffic::BlockCause::kNoRoute;
        return none ? traffic.admit(stand.vehicle, task, now) : elsewhere;
    };
    auto admitted = admit();
    const bool halfway = leg.released_nodes > 1 || leg.nodes.back().node_id != leg.station.str();
    if (!admitted && leg.order.empty() && halfway) {
        // It stands in others' way, on the way to a place that is not to be had: any other will do.
        task.resting.clear();
        const bool charges = std::exchange(leg.charges, false);
        admitted = admit();
        if (!admitted) leg.charges = charges;
    }
    if (!admitted) {
        stand.next_try = now + kRetry;
        if (!stand.in_vain_since) stand.in_vain_since = now;
        const auto block = traffic.blocked_by(stand.vehicle);
        return block ? floor_reason(fleet, *block) : admitted.error().reason;
    }
    stand.next_try.reset();
    stand.in_vain_since.reset();
    stand.leg_planned = true;
    run.swept = {};  // it was for the tries
    take_horizon(fleet, run);
    return std::nullopt;
}

bool stands_at_stop(const FleetState& fleet, const VehicleRun& run) {
    if (run.leg().nodes.size() == 1) return true;  // corrects or measures where it stands
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    return run.leg().passed_nodes == run.leg().nodes.size() && plan.passed < plan.last() &&
           plan.at(plan.passed + 1).visit != kNoVisit;
}

bool is_dead_end(const FleetState& fleet, const VehicleRun& run) {
    const Leg& leg = run.leg();
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    if (leg.nodes.size() < 2 || leg.passed_nodes < leg.released_nodes) return false;
    if (plan.place != kNoPlace || plan.last() > plan.passed) return false;
    if (!leg.nodes.back().actions.empty() && leg.nodes.size() == leg.released_nodes) return false;
    const auto end =
        class_of(fleet, run).motion.place_at(plant::HallId(leg.hall), leg.nodes.back().pose);
    return leg.nodes.size() == leg.released_nodes || !end;
}

bool is_stuck(const FleetState& fleet, const VehicleRun& run) {
    if (run.state.driving || run.leg().passed_nodes < run.leg().released_nodes) return false;
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    const auto block = fleet.floor.traffic.blocked_by(run.floor.vehicle);
    if (!block || block->cause != traffic::BlockCause::kVehicle) return false;
    return block->move == traffic::kForever || plan.last() > plan.passed;
}

bool goes_by_places(const FleetState& fleet, const VehicleRun& run) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n) {
        if (plan.at(n).place == kNoPlace) return false;
    }
    return true;
}

void take_plan_as_leg(FleetState& fleet, VehicleRun& run) {
    run.floor.moves_before_leg =
        static_cast<std::int64_t>(fleet.floor.traffic.plan(run.floor.vehicle).passed);
    run.floor.leg_planned = true;
    take_horizon(fleet, run);
}

void follow_replans(FleetState& fleet, Time now) {
    for (const auto vehicle : fleet.floor.traffic.take_replanned()) {
        VehicleRun* run = fleet.find(plant::VehicleId(fleet.floor.traffic.name(vehicle)));
        if (!run || !run->has_leg() || !run->floor.leg_planned || run->cancelling) continue;
        if (!take_horizon(fleet, *run)) continue;
        Leg& leg = run->leg();
        add_event(fleet, now, "leg.rerouted", leg.order, leg.id, leg.vehicle, {},
                  {{"nodes", static_cast<std::int64_t>(leg.nodes.size())},
                   {"from_node", static_cast<std::int64_t>(leg.released_nodes)}});
        fleet.store(*run);
        if (leg.released_nodes > 1 && leg.nodes.size() == leg.released_nodes &&
            !leg.nodes.back().actions.empty()) {
            // The vehicle has that node without the stop: it gets a leg of its own for that.
            leg.nodes.back().actions.clear();
            cancel_leg(fleet, *run, now);
            continue;
        }
        if (leg.released_nodes > 1 && !waits_for_person(*run) && run->leg_seen) {
            ++leg.update_id;
            send_order_update(fleet, *run, leg.released_nodes - 1, now);
        }
    }
}

std::size_t grant_nodes(FleetState& fleet, VehicleRun& run, std::size_t wanted_node, Time now) {
    auto& traffic = fleet.floor.traffic;
    const Leg& leg = run.leg();
    if (!run.floor.leg_planned || fleet.floor.stopped) return leg.released_nodes;
    const MoveNumber passed = traffic.plan(run.floor.vehicle).passed;
    const MoveNumber wanted = move_of_node(run, wanted_node);
    if (wanted <= passed) return leg.released_nodes;
    const MoveNumber granted = traffic.extend(run.floor.vehicle, wanted - passed, now);
    if (!floor_is_sound(fleet, now)) return leg.released_nodes;
    const auto nodes = static_cast<std::int64_t>(granted) - run.floor.moves_before_leg + 1;
    const auto reached = std::clamp(static_cast<std::size_t>(std::max<std::int64_t>(nodes, 1)),
                                    leg.released_nodes, leg.nodes.size());
    return keeps_to_its_floor(fleet, run, reached, now) ? reached : leg.released_nodes;
}

void pass_nodes(FleetState& fleet, VehicleRun& run, Time now) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    const std::size_t reported = run.leg().passed_nodes - 1;
    const MoveNumber move = move_of_node(run, reported);
    if (move <= plan.passed || plan.last() < move) return;
    if (!fleet.floor.traffic.passed(run.floor.vehicle, move, now)) {
        require_person(
            fleet, run,
            {"left_its_base",
             {{"vehicle", run.record.id.str()}, {"node", static_cast<std::int64_t>(reported)}}},
            now);
    }
}

void pass_stop(FleetState& fleet, VehicleRun& run, Time now) {
    auto& traffic = fleet.floor.traffic;
    const auto& plan = traffic.plan(run.floor.vehicle);
    const MoveNumber stop = plan.passed + 1;
    if (is_at_work(fleet, run)) return;  // measured once more
    if (stop > plan.last() || plan.at(stop).visit == kNoVisit) {
        // By plan it gives way first; it has made the stop all the same.
        if (traffic.postponed(run.floor.vehicle)) {
            static_cast<void>(traffic.cancel(run.floor.vehicle, now));
        }
        return;
    }
    if (traffic.extend(run.floor.vehicle, 1, now) < stop) {
        // Halted, for it was silent: the stop is made all the same, and is not to be made again.
        static_cast<void>(traffic.cancel(run.floor.vehicle, now));
        return;
    }
    static_cast<void>(traffic.passed(run.floor.vehicle, stop, now));
}

bool is_at_work(const FleetState& fleet, const VehicleRun& run) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    return plan.passed < plan.last() && plan.at(plan.passed + 1).visit == kWork;
}

void end_work(FleetState& fleet, VehicleRun& run, Time now) {
    auto& traffic = fleet.floor.traffic;
    const MoveNumber work = traffic.plan(run.floor.vehicle).passed + 1;
    if (!is_at_work(fleet, run) || traffic.extend(run.floor.vehicle, 1, now) < work) return;
    static_cast<void>(traffic.passed(run.floor.vehicle, work, now));
}

void give_up_task(FleetState& fleet, VehicleRun& run, Time now) {
    if (run.has_leg()) return;
    run.floor.leg_planned = false;
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    if (plan.last() == plan.passed) return;
    static_cast<void>(fleet.floor.traffic.cancel(run.floor.vehicle, now));
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

void halt_those_that_cannot_move(FleetState& fleet, Time now) {
    for (auto& [id, run] : fleet.vehicles) halt_or_resume(fleet, run, now);
}

bool tries_in_vain(const FleetState& fleet, const VehicleRun& run) {
    const JobOrder* order = fleet.orders.of(run.record.id);
    return run.floor.next_try && !run.has_leg() && order && order->state == JobState::kRunning;
}

void improve_floor(FleetState& fleet, Time now) {
    Floor& floor = fleet.floor;
    if (floor.stopped) return;
    if (!floor.improved || now - *floor.improved >= kImproveEvery) {
        floor.improved = now;
        floor.traffic.improve(now, kImproveSteps);
    }
    follow_replans(fleet, now);
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

}  // namespace pulseline::fleet
