#include "core/fleet/floor/admission.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fleet/floor/floor.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/leg_build.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
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
constexpr double kSamePose_m = 1e-3;
constexpr double kSamePose_rad = 1e-3;
constexpr Duration kRetry = std::chrono::seconds(1);  // of a barred admission: it is a search

bool same_pose(const Pose2& a, const Pose2& b) {
    return geometry::distance(a.position(), b.position()) < kSamePose_m &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) < kSamePose_rad;
}

/// It brings its load to where it cannot rest: it stays there until others need the floor.
bool works_at(const LiveVehicle& live, const plant::Station& station) {
    return is_loaded(live) && !station.resting_place;
}

/// What the leg's task is part of, and where the order goes on to.
void describe_order(const FleetState& fleet, const LiveVehicle& live, const JobOrder& order,
                    traffic::Task& task) {
    task.purpose = static_cast<std::uint64_t>(order.number);
    task.since_s = seconds(order.created.time_since_epoch());
    for (std::size_t i = order.current_step + 1; i < order.steps.size(); ++i) {
        const auto place = floor_class_of(fleet, live).motion.station_place(order.steps[i].station);
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

/// The leg's edges behind its base as traffic takes them.
traffic::Sequence sequence_of(const FleetState& fleet, const LiveVehicle& live) {
    const Leg& leg = live.leg();
    const FloorClass& of_class = floor_class_of(fleet, live);
    traffic::Sequence sequence;
    for (std::size_t i = leg.released_nodes; i < leg.nodes.size(); ++i) {
        traffic::Sequence::Step step;
        step.swept = floor_of_edge(fleet, live, leg.edges[i - 1]);
        step.place = exact_place(of_class, leg.hall, leg.nodes[i].pose);
        step.stand =
            step.place != kNoPlace ? of_class.stands[step.place] : floor_at_node(fleet, live, i);
        step.duration_s = std::max(0.1, leg.edges[i - 1].segment.duration_s);
        sequence.steps.push_back(std::move(step));
    }
    return sequence;
}

vda5050::OrderNode horizon_node(const Leg& leg, const Pose2& pose) {
    vda5050::OrderNode node;
    const std::size_t index = leg.nodes.size();
    node.node_id = "p" + std::to_string(index);
    node.sequence_id = static_cast<std::int64_t>(2 * index);
    node.pose = pose;
    node.map_id = leg.hall;
    return node;
}

vda5050::OrderEdge horizon_edge(const Leg& leg, kinematics::Segment segment) {
    vda5050::OrderEdge edge;
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
    vda5050::OrderEdge edge = horizon_edge(leg, std::move(segment));
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
bool take_horizon(FleetState& fleet, LiveVehicle& live) {
    Leg& leg = live.leg();
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    const FloorClass& of_class = floor_class_of(fleet, live);
    // The stop is in the base: the vehicle makes it, whatever the plan would do before.
    if (leg.released_nodes == leg.nodes.size() && !leg.nodes.back().actions.empty()) return false;
    const auto is_drive = [&](MoveNumber n) {
        return n <= plan.last() && plan.at(n).visit == kNoVisit;
    };
    std::size_t node = leg.released_nodes;
    for (; node < leg.nodes.size() && is_drive(move_of_node(live, node)); ++node) {
        const auto& move = plan.at(move_of_node(live, node));
        // Without a place it is the leg's own step: those never come from a search.
        if (move.place == kNoPlace) continue;
        if (!same_pose(of_class.motion.places[move.place].pose, leg.nodes[node].pose)) break;
    }
    const bool ends = !is_drive(move_of_node(live, node));
    const bool has_stop = move_of_node(live, node) <= plan.last() && ends;
    if (node == leg.nodes.size() && ends &&
        (leg.order.empty() || has_stop == !leg.nodes.back().actions.empty())) {
        return false;
    }
    leg.nodes.resize(node);
    leg.edges.resize(node - 1);
    live.areas = {};  // they are of the old horizon
    live.leg_markers.reset();
    // What was the stop may only be passed now, and is stopped at later.
    for (std::size_t i = leg.released_nodes; i < node; ++i) {
        if (leg.nodes[i].actions.empty()) continue;
        leg.nodes[i].actions.clear();
        leg.nodes[i].node_id = "p" + std::to_string(i);
    }
    MoveNumber next = move_of_node(live, node);
    for (; is_drive(next); ++next) {
        const MoveNumber n = next;
        const traffic::PlaceIndex before = plan.place_after(n - 1);
        append_move(of_class, leg, plan.at(n).place,
                    before == kNoPlace ? std::nullopt : std::optional(before));
    }
    bool rests = false;
    if (leg.order.empty()) {
        // Making way ends wherever the plan found a resting place this time; or it waits where its
        // base ends for a way to one.
        const auto end = plan.place_after(plan.last());
        const bool at_station = end != kNoPlace && !of_class.motion.places[end].station.empty();
        if (at_station) leg.station = of_class.motion.places[end].station;
        rests = leg.nodes.size() > 1 && !fleet.floor.traffic.postponed(live.floor.vehicle);
    }
    const auto* station = plant::find_station(fleet.plant, leg.station);
    // Who works where it stands until somebody needs the floor has nothing to make way for yet.
    const bool stops = next <= plan.last() && !(leg.order.empty() && leg.nodes.size() == 1);
    if (station && (stops || rests)) {
        leg.nodes.back().node_id = station->id.str();
        leg.nodes.back().actions = leg.order.empty() ? rest_actions(fleet, live, *station, leg)
                                                     : stop_actions(fleet, live, *station, leg.id);
    }
    widen_nodes(leg);
    leg.duration_s = 0;
    for (const auto& edge : leg.edges) leg.duration_s += edge.segment.duration_s;
    return true;
}

}  // namespace

std::optional<Reason> plan_on_floor(FleetState& fleet, LiveVehicle& live, Time now) {
    auto& traffic = fleet.floor.traffic;
    auto& stand = live.floor;
    if (stand.conflict) return stand.conflict;
    if (fleet.floor.stopped) return fleet.floor.stopped;
    Leg& leg = live.leg();
    const auto target = floor_class_of(fleet, live).motion.station_place(leg.station);
    if (!target) {
        return Reason{"station_not_for_type",
                      {{"station", leg.station.str()}, {"vehicle_type", live.type->name}}};
    }
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
        if (station && works_at(live, *station)) task.visits.push_back({goal, kWork_s});
        if (const auto* order = fleet.find(leg.order)) describe_order(fleet, live, *order, task);
    }
    auto sequence = sequence_of(fleet, live);
    if (!sequence.steps.empty()) {
        // A horizon of before a restart may lead elsewhere, to give way: the search goes on there.
        const auto end = floor_class_of(fleet, live)
                             .motion.place_at(plant::HallId(leg.hall), leg.nodes.back().pose);
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
    live.swept = {};  // it was for the tries
    // It may end elsewhere now: the store and the dashboards have the old one.
    if (take_horizon(fleet, live)) fleet.store(live);
    return std::nullopt;
}

void take_plan_as_leg(FleetState& fleet, LiveVehicle& live) {
    live.floor.moves_before_leg =
        static_cast<std::int64_t>(fleet.floor.traffic.plan(live.floor.vehicle).passed);
    live.floor.leg_planned = true;
    take_horizon(fleet, live);
}

void follow_replans(FleetState& fleet, Time now) {
    for (const auto vehicle : fleet.floor.traffic.take_replanned()) {
        LiveVehicle* live = fleet.find(plant::VehicleId(fleet.floor.traffic.name(vehicle)));
        if (!live || !live->has_leg() || !live->floor.leg_planned || live->delivery.cancelling())
            continue;
        if (!take_horizon(fleet, *live)) continue;
        Leg& leg = live->leg();
        add_event(fleet, now, event::kLegRerouted, leg.order, leg.id, leg.vehicle, {},
                  {{"nodes", static_cast<std::int64_t>(leg.nodes.size())},
                   {"from_node", static_cast<std::int64_t>(leg.released_nodes)}});
        fleet.store(*live);
        if (leg.released_nodes > 1 && leg.nodes.size() == leg.released_nodes &&
            !leg.nodes.back().actions.empty()) {
            // The vehicle has that node without the stop: it gets a leg of its own for that.
            leg.nodes.back().actions.clear();
            cancel_leg(fleet, *live, now);
            continue;
        }
        if (leg.released_nodes > 1 && !waits_for_person(*live) && live->delivery.seen()) {
            ++leg.update_id;
            send_order_update(fleet, *live, leg.released_nodes - 1, now);
        }
    }
}

}  // namespace pulseline::fleet
