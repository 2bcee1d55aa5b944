#include <algorithm>
#include <cmath>

#include "core/fleet/state.hpp"
#include "core/kinematics/motion.hpp"

namespace pulseline::fleet {
namespace {

using kinematics::Segment;

// Nodes about this far apart: the base can grow in pieces, and floor behind is freed as it is left.
constexpr double kNodeSpacing_m = 4.0;
// Position error of a moving vehicle plus rounding; the planner's clearance is far larger.
constexpr double kFloorMargin_m = 0.10;
// Time from "node passed" on the vehicle to the extended base being there: report interval, tick,
// commit and link, with reserve.
constexpr double kExtendLatency_s = 0.5;

std::vector<Segment> split(const plant::VehicleType& type, const Segment& segment) {
    const double length = std::abs(segment.length_m);
    const int pieces =
        segment.kind == Segment::Kind::kRotate
            ? 1
            : std::max(1, static_cast<int>(std::ceil(length / kNodeSpacing_m - 1e-9)));
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
                                      marker->size_m, marker->pose, marker->sigma_xy_m});
        }
    }
    return target;
}

bool announces(const VehicleRun& run, const std::string& action) {
    if (!run.factsheet) return true;  // not heard yet: our own agents announce it at once
    const auto& actions = run.factsheet->actions;
    return std::find(actions.begin(), actions.end(), action) != actions.end();
}

/// What the vehicle does at the station node: correct the stop, then measure it.
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

}  // namespace

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

Leg build_leg(const FleetState& fleet, const VehicleRun& run, const planning::LegPlan& plan,
              const plant::Station& station, const Pose2& start, LegId id) {
    Leg leg;
    leg.id = id;
    leg.vehicle = run.record.id;
    leg.station = station.id;
    leg.mode = plan.mode;
    leg.hall = station.hall.str();
    leg.duration_s = plan.duration_s;
    leg.nodes.push_back(node_at("start", 0, start, leg.hall));
    leg.nodes.front().released = true;
    leg.nodes.front().allowed_deviation_xy_m = 0.3;
    leg.nodes.front().allowed_deviation_theta_rad = 0.1;
    for (const auto& segment : plan.segments) {
        for (const auto& piece : split(*run.type, segment)) {
            const std::size_t index = leg.nodes.size();
            OrderEdge edge;
            edge.edge_id = "e" + std::to_string(index);
            edge.sequence_id = static_cast<std::int64_t>(2 * index - 1);
            edge.segment = piece;
            leg.edges.push_back(std::move(edge));
            leg.nodes.push_back(node_at("p" + std::to_string(index), index, piece.end, leg.hall));
        }
    }
    auto& last = leg.nodes.back();
    last.node_id = station.id.str();
    last.actions = stop_actions(fleet, run, station, id);
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
    leg.nodes.push_back(node_at(station.id.str(), 0, pose, leg.hall));
    leg.nodes.front().released = true;
    leg.nodes.front().allowed_deviation_xy_m = 0.3;
    leg.nodes.front().allowed_deviation_theta_rad = 0.1;
    leg.nodes.front().actions = stop_actions(fleet, run, station, id);
    return leg;
}

std::vector<traffic::TileSet> tiles_of(const FleetState& fleet, const VehicleRun& run,
                                       const Leg& leg) {
    const auto body = plant::outline_with_load(*run.type, is_loaded(run));
    const std::size_t hall = hall_index(fleet, leg.hall);
    std::vector<traffic::TileSet> tiles;
    for (const auto& edge : leg.edges) {
        tiles.push_back(
            traffic::tiles_under(hall, kinematics::sweep(body, {edge.segment}), kFloorMargin_m));
    }
    if (leg.edges.empty()) {
        tiles.push_back(
            traffic::tiles_under(hall, outline_at(run, leg.nodes.front().pose), kFloorMargin_m));
    }
    return tiles;
}

void extend_base(FleetState& fleet, VehicleRun& run, Time now) {
    Leg& leg = run.leg();
    if (leg.released_nodes >= leg.nodes.size() || run.cancelling) return;
    const double speed = speed_of(run);
    const double wanted_m = speed * speed / (2 * accel_of(run)) + speed * kExtendLatency_s;
    double ahead_m = -run.state.distance_since_last_node_m;
    for (std::size_t i = leg.passed_nodes; i < leg.released_nodes; ++i) {
        ahead_m += std::abs(leg.edges[i - 1].segment.length_m);
    }
    const std::size_t before = leg.released_nodes;
    while (leg.released_nodes < leg.nodes.size()) {
        const bool first = leg.released_nodes == 1;
        if (!first && ahead_m >= wanted_m) break;
        // A turn on the spot ends standing anyway: released with the move behind it.
        ahead_m += std::abs(leg.edges[leg.released_nodes - 1].segment.length_m);
        leg.edges[leg.released_nodes - 1].released = true;
        leg.nodes[leg.released_nodes].released = true;
        ++leg.released_nodes;
    }
    if (leg.released_nodes == before) return;
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
    ++run.update_sends;
}

void free_floor_behind(FleetState& fleet, VehicleRun& run) {
    traffic::TileSet needed;
    if (run.has_leg() && !run.edge_tiles.empty()) {
        // Edge i starts at node i, so its floor includes the body standing there.
        const std::size_t first = std::min(run.leg().passed_nodes - 1, run.edge_tiles.size() - 1);
        for (std::size_t i = first; i < run.edge_tiles.size(); ++i) {
            needed = traffic::merge(needed, run.edge_tiles[i]);
        }
    } else if (run.record.pose_known) {
        needed = traffic::tiles_under(hall_index(fleet, hall_of(fleet, run)),
                                      outline_at(run, run.record.pose), kFloorMargin_m);
    } else {
        return;  // nobody knows where it is: it keeps all it had
    }
    fleet.tiles.keep_only(run.record.id, needed);
    fleet.tiles.try_hold(run.record.id, needed);
}

void drop_leg(FleetState& fleet, VehicleRun& run) {
    run.record.has_leg = false;
    run.record.leg = LegId{};
    run.record.leg_data = Leg{};
    run.leg_seen = false;
    run.update_sent.reset();
    run.update_sends = 0;
    run.cancelling = false;
    run.edge_tiles.clear();
    run.leg_started.reset();
    free_floor_behind(fleet, run);
    fleet.store(run);
}

}  // namespace pulseline::fleet
