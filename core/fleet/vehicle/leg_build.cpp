#include "core/fleet/vehicle/leg_build.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/kinematics/motion.hpp"
#include "core/kinematics/primitives.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

using kinematics::Segment;

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

vda5050::StopTarget stop_target(const plant::Plant& plant, const plant::Station& station) {
    vda5050::StopTarget target{.station_id = station.id.str(),
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

bool announces(const LiveVehicle& live, const std::string& action) {
    if (!live.factsheet) return true;  // not heard yet: our own agents announce it at once
    const auto& actions = live.factsheet->actions;
    return std::find(actions.begin(), actions.end(), action) != actions.end();
}

vda5050::OrderNode node_at(const std::string& name, std::size_t index, const Pose2& pose,
                           const std::string& map_id) {
    vda5050::OrderNode node;
    node.node_id = name;
    node.sequence_id = static_cast<std::int64_t>(2 * index);
    node.pose = pose;
    node.map_id = map_id;
    return node;
}

}  // namespace

void widen_nodes(Leg& leg) {
    for (std::size_t i = std::max<std::size_t>(1, leg.released_nodes); i < leg.edges.size(); ++i) {
        const vda5050::OrderEdge& edge = leg.edges[i - 1];
        const vda5050::OrderEdge& next = leg.edges[i];
        const auto room = room_between(edge.segment, edge.corridor, next.segment, next.corridor);
        leg.nodes[i].allowed_deviation_xy_m = room && leg.nodes[i].actions.empty()
                                                  ? std::max(room->left_m, room->right_m)
                                                  : vda5050::OrderNode{}.allowed_deviation_xy_m;
    }
}

std::vector<vda5050::Action> stop_actions(const FleetState& fleet, const LiveVehicle& live,
                                          const plant::Station& station, const LegId& leg) {
    std::vector<vda5050::Action> actions;
    if (station.markers.empty() && live.type->receivers.empty()) return actions;
    for (const char* type : {vda5050::kAdjustToMarker, vda5050::kMeasureStop}) {
        if (!announces(live, type)) continue;
        vda5050::Action action;
        action.type = type;
        action.id = leg.str() + "-" + type;
        action.stop_target = stop_target(fleet.plant, station);
        actions.push_back(std::move(action));
    }
    return actions;
}

std::vector<vda5050::Action> rest_actions(const FleetState& fleet, const LiveVehicle& live,
                                          const plant::Station& station, const Leg& leg) {
    std::vector<vda5050::Action> actions = stop_actions(fleet, live, station, leg.id);
    // It is no stop to keep.
    std::erase_if(actions, [](const vda5050::Action& action) {
        return action.type == vda5050::kMeasureStop;
    });
    if (leg.charges) {
        vda5050::Action action;
        action.type = vda5050::kStartCharging;
        action.id = leg.id.str() + "-startCharging";
        actions.push_back(std::move(action));
    }
    return actions;
}

vda5050::OrderNode start_node(const Pose2& pose, const std::string& hall) {
    vda5050::OrderNode node = node_at("start", 0, pose, hall);
    node.released = true;
    node.allowed_deviation_xy_m = 0.3;
    node.allowed_deviation_theta_rad = 0.1;
    return node;
}

Leg build_leg(const FleetState& fleet, const LiveVehicle& live, const planning::LegPlan& plan,
              const plant::Station& station, const Pose2& start, LegId id) {
    Leg leg;
    leg.id = id;
    leg.vehicle = live.record.id;
    leg.station = station.id;
    leg.mode = plan.mode;
    leg.hall = station.hall.str();
    leg.duration_s = plan.duration_s;
    leg.nodes.push_back(start_node(start, leg.hall));
    for (std::size_t i = 0; i < plan.segments.size(); ++i) {
        for (const auto& piece : split(*live.type, plan.segments[i])) {
            const std::size_t index = leg.nodes.size();
            vda5050::OrderEdge edge;
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
    last.actions = stop_actions(fleet, live, station, id);
    widen_nodes(leg);
    return leg;
}

Leg build_adjust_leg(const FleetState& fleet, const LiveVehicle& live,
                     const plant::Station& station, const Pose2& pose, LegId id) {
    Leg leg;
    leg.id = id;
    leg.vehicle = live.record.id;
    leg.station = station.id;
    leg.mode = plant::MotionMode::kLinear;
    leg.hall = station.hall.str();
    leg.nodes.push_back(start_node(pose, leg.hall));
    leg.nodes.front().node_id = station.id.str();
    leg.nodes.front().actions = stop_actions(fleet, live, station, id);
    return leg;
}

}  // namespace pulseline::fleet
