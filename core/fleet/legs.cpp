#include <algorithm>
#include <cmath>

#include "core/fleet/state.hpp"
#include "core/kinematics/motion.hpp"

namespace pulseline::fleet {
namespace {

using kinematics::Segment;

// Time from "node passed" on the vehicle to the extended base being there: report interval, tick,
// commit and link, with reserve.
constexpr double kExtendLatency_s = 0.5;

std::vector<Segment> split(const plant::VehicleType& type, const Segment& segment) {
    const double length = std::abs(segment.length_m);
    const int pieces =
        segment.kind == Segment::Kind::kRotate
            ? 1
            : std::max(1, static_cast<int>(std::ceil(length / planning::kLanePiece_m - 1e-9)));
    if (pieces == 1) return {segment};
    std::vector<Segment> parts;
    for (int i = 0; i < pieces; ++i) {
        parts.push_back(kinematics::part(type, segment, static_cast<double>(i) / pieces,
                                         static_cast<double>(i + 1) / pieces));
    }
    return parts;
}

StopTarget stop_target(const plant::Plant& plant, const plant::Station& station) {
    StopTarget target{.station_id = station.id.str(),
                      .station_number = station.number,
                      .target = station.pose,
                      .tolerance_x_m = station.tolerance.dx_m,
                      .tolerance_y_m = station.tolerance.dy_m,
                      .tolerance_heading_rad = station.tolerance.dheading_rad,
                      .markers = {}};
    for (const auto& id : station.markers) {
        if (const auto* marker = plant::find_marker(plant, id)) {
            target.markers.push_back({marker->payload, plant::to_string(marker->kind),
                                      marker->size_m, marker->pose, marker->sigma_xy_m,
                                      marker->sigma_heading_rad});
        }
    }
    return target;
}

bool announces(const VehicleRun& run, const std::string& action) {
    if (!run.factsheet) return true;  // not heard yet: our own agents announce it at once
    const auto& actions = run.factsheet->actions;
    return std::find(actions.begin(), actions.end(), action) != actions.end();
}

OrderNode node_at(const std::string& name, std::size_t index, const Pose2& pose,
                  const std::string& map_id) {
    OrderNode node;
    node.node_id = name;
    node.sequence_id = static_cast<std::int64_t>(2 * index);
    node.pose = pose;
    node.map_id = map_id;
    return node;
}

/// The real limits of the vehicle: its factsheet's where it sent one.
double speed_of(const VehicleRun& run) {
    return run.factsheet && run.factsheet->speed_max_mps > 0 ? run.factsheet->speed_max_mps
                                                             : run.type->max_speed_mps;
}
double accel_of(const VehicleRun& run) {
    return run.factsheet && run.factsheet->acceleration_max_mps2 > 0
               ? run.factsheet->acceleration_max_mps2
               : run.type->max_accel_mps2;
}

/// Barred where it may leave its line, it asks for more of the lane to go round what stands there.
bool wants_room(const VehicleRun& run) {
    const Leg& leg = run.leg();
    return run.state.field_violation && run.state.new_base_request &&
           leg.edges[leg.released_nodes - 1].corridor.has_value();
}

/// Standing at the end of its base, it waits for somebody; still driving, it does not.
void tell_wait(FleetState& fleet, VehicleRun& run, Time now) {
    if (run.leg().passed_nodes < run.leg().released_nodes) return;
    JobOrder* order = fleet.find(run.leg().order);
    if (!order || order->state != JobState::kRunning) return;
    const auto wait = floor_wait(fleet, run);
    if (!wait) return;
    set_order_reason(fleet, *order, *wait, now);
    fleet.changed_vehicles.insert(run.record.id);
}

}  // namespace

std::vector<Action> stop_actions(const FleetState& fleet, const VehicleRun& run,
                                 const plant::Station& station, const LegId& leg) {
    std::vector<Action> actions;
    if (station.markers.empty()) return actions;
    for (const char* type : {"adjustToMarker", "measureStop"}) {
        if (!announces(run, type)) continue;
        Action action;
        action.type = type;
        action.id = leg.str() + "-" + type;
        action.stop_target = stop_target(fleet.plant, station);
        actions.push_back(std::move(action));
    }
    return actions;
}

std::vector<Action> rest_actions(const FleetState& fleet, const VehicleRun& run,
                                 const plant::Station& station, const Leg& leg) {
    std::vector<Action> actions = stop_actions(fleet, run, station, leg.id);
    // It is no stop to keep.
    std::erase_if(actions, [](const Action& action) { return action.type == "measureStop"; });
    if (leg.charges) {
        Action action;
        action.type = "startCharging";
        action.id = leg.id.str() + "-startCharging";
        actions.push_back(std::move(action));
    }
    return actions;
}

planning::LegRequest leg_request(const FleetState& fleet, const VehicleRun& run, const Pose2& start,
                                 const plant::StationId& target, plant::MotionMode mode) {
    planning::LegRequest request;
    request.type = run.type;
    request.loaded = is_loaded(run);
    request.hall = plant::HallId(hall_of(fleet, run));
    request.start = start;
    request.from_station = station_at(fleet, run, start);
    request.target = target;
    request.mode = mode;
    return request;
}

OrderNode start_node(const Pose2& pose, const std::string& hall) {
    OrderNode node = node_at("start", 0, pose, hall);
    node.released = true;
    node.allowed_deviation_xy_m = 0.3;
    node.allowed_deviation_theta_rad = 0.1;
    return node;
}

Leg build_leg(const FleetState& fleet, const VehicleRun& run, const planning::LegPlan& plan,
              const plant::Station& station, const Pose2& start, LegId id) {
    Leg leg;
    leg.id = id;
    leg.vehicle = run.record.id;
    leg.station = station.id;
    leg.mode = plan.mode;
    leg.hall = station.hall.str();
    leg.duration_s = plan.duration_s;
    leg.nodes.push_back(start_node(start, leg.hall));
    for (std::size_t i = 0; i < plan.segments.size(); ++i) {
        for (const auto& piece : split(*run.type, plan.segments[i])) {
            const std::size_t index = leg.nodes.size();
            OrderEdge edge;
            edge.edge_id = "e" + std::to_string(index);
            edge.sequence_id = static_cast<std::int64_t>(2 * index - 1);
            edge.segment = piece;
            if (!plan.max_speed_mps.empty()) edge.max_speed_mps = plan.max_speed_mps[i];
            edge.corridor = fleet.tables->lanes.along(station.hall, piece).corridor;
            leg.edges.push_back(std::move(edge));
            leg.nodes.push_back(node_at("p" + std::to_string(index), index, piece.end, leg.hall));
        }
    }
    auto& last = leg.nodes.back();
    last.node_id = station.id.str();
    last.actions = stop_actions(fleet, run, station, id);
    widen_nodes(leg);
    return leg;
}

Leg build_adjust_leg(const FleetState& fleet, const VehicleRun& run, const plant::Station& station,
                     const Pose2& pose, LegId id) {
    Leg leg;
    leg.id = id;
    leg.vehicle = run.record.id;
    leg.station = station.id;
    leg.mode = plant::MotionMode::kLinear;
    leg.hall = station.hall.str();
    leg.nodes.push_back(start_node(pose, leg.hall));
    leg.nodes.front().node_id = station.id.str();
    leg.nodes.front().actions = stop_actions(fleet, run, station, id);
    return leg;
}

void take_leg(VehicleRun& run, Leg leg) {
    run.record.has_leg = true;
    run.record.leg = leg.id;
    run.record.leg_data = std::move(leg);
    run.leg_seen = false;
    run.update_sent.reset();
    run.update_sends = 0;
    run.order_sent.reset();
    run.gave_up = false;
    run.leg_started.reset();
    run.floor.idle_since.reset();
}

std::optional<Reason> try_leg(FleetState& fleet, VehicleRun& run, Leg leg, Time now) {
    const VehicleRecord before = run.record;
    const auto idle_since = run.floor.idle_since;
    take_leg(run, std::move(leg));
    if (run.leg().nodes.size() == 1) return std::nullopt;
    auto reason = plan_on_floor(fleet, run, now);
    if (reason) {
        run.record = before;
        run.floor.idle_since = idle_since;
    }
    return reason;
}

void send_leg(FleetState& fleet, VehicleRun& run, Time now) {
    if (run.leg().nodes.size() == 1) {
        send_order_update(fleet, run, 0, now);
    } else {
        extend_base(fleet, run, now);
    }
}

void extend_base(FleetState& fleet, VehicleRun& run, Time now) {
    follow_replans(fleet, now);  // what is released has to be what the plan has now
    Leg& leg = run.leg();
    if (run.cancelling) return;
    if (leg.released_nodes >= leg.nodes.size()) {
        // With the stop in its base it waits for nobody.
        if (leg.nodes.back().actions.empty()) tell_wait(fleet, run, now);
        return;
    }
    const double speed = speed_of(run);
    const double wanted_m = speed * speed / (2 * accel_of(run)) + speed * kExtendLatency_s;
    double ahead_m = -run.state.distance_since_last_node_m;
    for (std::size_t i = leg.passed_nodes; i < leg.released_nodes; ++i) {
        ahead_m += std::abs(leg.edges[i - 1].segment.length_m);
    }
    std::size_t wanted = leg.released_nodes;
    const std::size_t least = wanted + (wants_room(run) ? 1 : 0);
    while (wanted < leg.nodes.size() && (wanted == 1 || wanted < least || ahead_m < wanted_m)) {
        // A turn on the spot ends standing anyway: released with the move behind it.
        ahead_m += std::abs(leg.edges[wanted - 1].segment.length_m);
        ++wanted;
    }
    const std::size_t before = leg.released_nodes;
    if (wanted == before) return;
    const std::size_t granted = grant_nodes(fleet, run, wanted - 1, now);
    if (granted == before) return tell_wait(fleet, run, now);
    for (std::size_t i = before; i < granted; ++i) {
        leg.edges[i - 1].released = true;
        leg.nodes[i].released = true;
    }
    leg.released_nodes = granted;
    JobOrder* order = fleet.find(leg.order);
    if (order && order->state == JobState::kRunning) {
        set_order_reason(fleet, *order, {}, now);
        if (!order->expected && run.leg_seen) expect_end(fleet, run, *order, now);
    }
    const bool is_new = before == 1 && !run.update_sent && !run.leg_seen;
    if (!is_new) ++leg.update_id;
    send_order_update(fleet, run, is_new ? 0 : before - 1, now);
    add_event(fleet, now, "leg.released", leg.order, leg.id, leg.vehicle, {},
              {{"nodes", static_cast<std::int64_t>(leg.released_nodes)},
               {"of", static_cast<std::int64_t>(leg.nodes.size())},
               {"update", leg.update_id}});
    fleet.store(run);
}

void send_order_update(FleetState& fleet, VehicleRun& run, std::size_t from, Time now) {
    const Leg& leg = run.leg();
    OrderMessage message;
    message.order_id = leg.id.str();
    message.order_update_id = leg.update_id;
    const auto offset = static_cast<std::ptrdiff_t>(from);
    message.nodes.assign(leg.nodes.begin() + offset, leg.nodes.end());
    message.edges.assign(leg.edges.begin() + offset, leg.edges.end());
    fleet.out.messages.push_back({run.record.id, std::move(message), std::nullopt});
    run.update_from = from;
    run.update_sent = now;
    if (run.connected) run.order_sent = now;
    ++run.update_sends;
}

void drop_leg(FleetState& fleet, VehicleRun& run, Time now, bool arrived) {
    run.record.has_leg = false;
    run.record.leg = LegId{};
    run.record.leg_data = Leg{};
    run.leg_seen = false;
    run.update_sent.reset();
    run.update_sends = 0;
    run.order_sent.reset();
    run.gave_up = false;
    run.cancelling = false;
    // Repeated, it would hit the next leg.
    std::erase_if(run.actions, [](const auto& p) { return p.action.type == "cancelOrder"; });
    run.leg_started.reset();
    run.floor.leg_planned = false;
    run.floor.idle_since.reset();
    settle(fleet, run, now, !arrived);
    fleet.store(run);
}

}  // namespace pulseline::fleet
