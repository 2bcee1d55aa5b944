#pragma once

#include <cmath>

#include "api/vda5050/header.hpp"
#include "core/base/angle.hpp"
#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"

/// One message of each kind that uses every field we send.
namespace pulseline::vda5050::testing {

using geometry::Pose2;
using kinematics::Segment;

inline Header header() { return {7, "2026-01-31T12:00:00.123Z", "Tang", "TP-01"}; }

inline Segment straight(const Pose2& from, double length_m, double direction_rad) {
    Segment s;
    s.kind = Segment::Kind::kStraight;
    s.start = from;
    s.end = from * Pose2{length_m * std::cos(direction_rad), length_m * std::sin(direction_rad), 0};
    s.length_m = length_m;
    s.direction_rad = direction_rad;
    return s;
}
inline Segment turn(const Pose2& from, double turn_rad) {
    Segment s;
    s.kind = Segment::Kind::kRotate;
    s.start = from;
    s.end = from * Pose2{0, 0, turn_rad};
    s.turn_rad = turn_rad;
    return s;
}
/// Tangential arc: centre to the left for a positive radius of the drawn way.
inline Segment arc(const Pose2& from, double radius_m, double turn_rad, bool backwards) {
    Segment s;
    s.kind = Segment::Kind::kArc;
    s.start = from;
    const bool left_of_way = turn_rad > 0;
    const bool left_of_body = left_of_way != backwards;
    s.centre = from * geometry::Point2{0, left_of_body ? radius_m : -radius_m};
    const auto r = from.position() - s.centre;
    const auto end = s.centre + Pose2{0, 0, turn_rad} * r;
    s.end = {end.x_m, end.y_m, wrap(from.heading_rad + turn_rad)};
    s.turn_rad = turn_rad;
    s.length_m = (backwards ? -1 : 1) * radius_m * std::abs(turn_rad);
    return s;
}

/// Straight with an even turn on the way.
inline Segment combined(const Pose2& from, double length_m, double direction_rad, double turn_rad) {
    Segment s = straight(from, length_m, direction_rad);
    s.kind = Segment::Kind::kCombined;
    s.end.heading_rad = wrap(s.end.heading_rad + turn_rad);
    s.turn_rad = turn_rad;
    return s;
}

inline vda5050::StopTarget stop_target() {
    vda5050::StopTarget target{"st02", 2, {17, 12.3, 0.01}, 0.025, 0.025, 0.0035, {}};
    target.markers = {{"ST02-F", "qr", 0.06, {20, 12, 0.1}, 0.0001, 0.0004},
                      {"ST02-B", "qr", 0.06, {14, 12, 0.2}, 0.0001, 0.0005}};
    return target;
}

/// A straight, a turn, a sideways move, arcs and a move that turns on its way; the last edge is
/// horizon.
inline vda5050::OrderMessage order() {
    vda5050::OrderMessage message;
    message.order_id = "leg-1";
    message.order_update_id = 3;
    Pose2 at{10, 12.3, 0.2};
    const auto add_node = [&](const Pose2& pose, bool released) {
        vda5050::OrderNode node;
        node.node_id = "p" + std::to_string(message.nodes.size());
        node.sequence_id = 4 + 2 * static_cast<std::int64_t>(message.nodes.size());
        node.released = released;
        node.pose = pose;
        node.map_id = "hall-1";
        message.nodes.push_back(node);
    };
    add_node(at, true);
    const auto add = [&](const Segment& segment, bool released) {
        vda5050::OrderEdge edge;
        edge.edge_id = "e" + std::to_string(message.edges.size());
        edge.sequence_id = 5 + 2 * static_cast<std::int64_t>(message.edges.size());
        edge.released = released;
        edge.segment = segment;
        edge.max_speed_mps = 0.4;
        message.edges.push_back(edge);
        at = segment.end;
        add_node(at, released);
    };
    add(straight(at, 6, 0), true);
    message.edges.back().corridor = {1.4, 0.9};
    vda5050::Action observe;
    observe.type = "observeMarkers";
    observe.id = "leg-1-e0-observeMarkers";
    observe.blocking = vda5050::BlockingType::kNone;
    observe.markers = stop_target().markers;
    observe.segment_markers = {observe.markers[0].payload, observe.markers[1].payload};
    observe.boundary_marker = observe.markers[1].payload;
    message.edges.back().actions = {observe};
    add(straight(at, 2, kPi), true);
    add(turn(at, -1.3), true);
    add(turn(at, -kPi), true);
    add(straight(at, 1.5, kPi / 2), true);
    add(straight(at, 1.5, -2.0), true);
    add(arc(at, 12, 2.5, false), true);
    add(arc(at, 9, -0.4, false), true);
    add(arc(at, 30, 0.8, true), true);
    add(combined(at, 3, 1.2, -0.8), true);
    add(arc(at, 30, -1.9, true), false);
    vda5050::Action adjust;
    adjust.type = "adjustToMarker";
    adjust.id = "leg-1-adjust";
    adjust.stop_target = stop_target();
    vda5050::Action measure = adjust;
    measure.type = "measureStop";
    measure.id = "leg-1-measure";
    message.nodes.back().actions = {adjust, measure};
    return message;
}

inline vda5050::InstantActionsMessage instant_actions() {
    vda5050::Action cancel;
    cancel.type = "cancelOrder";
    cancel.id = "c-1";
    cancel.params = {{"reason", std::string("operator")}, {"hard", true}, {"level", 2.5}};
    vda5050::Action init;
    init.type = "initPosition";
    init.id = "i-1";
    init.blocking = vda5050::BlockingType::kNone;
    init.init_position =
        vda5050::InitPosition{{1.5, -2, 0.3}, "hall-1", "st01", 0.005, 0.001, true};
    return {{cancel, init}};
}

inline vda5050::StateMessage state() {
    vda5050::StateMessage state;
    state.order_id = "leg-1";
    state.order_update_id = 3;
    state.last_node_id = "p1";
    state.last_node_sequence_id = 6;
    state.node_states = {{"p2", 8, true}, {"p3", 10, false}};
    state.edge_states = {{"e1", 7, true}, {"e2", 9, false}};
    state.driving = true;
    state.paused = true;
    state.new_base_request = true;
    state.distance_since_last_node_m = 1.25;
    state.pose = Pose2{11, 12.5, -3};
    state.position_initialized = true;
    state.localization_score = 0.9;
    state.deviation_range_m = 0.004;
    state.map_id = "hall-1";
    state.velocity_mps = -0.3;
    state.turn_rate_radps = 0.02;
    state.battery_percent = 81.5;
    vda5050::StopMeasurement found{{17.001, 12.299, 0.0101}, 1e-4, 2e-5, "dual_camera",
                                   {"ST02-F", "ST02-B"},     {}};
    found.arrived = Pose2{17.004, 12.305, 0.012};
    state.action_states = {
        {"leg-1-measure", "measureStop", vda5050::ActionStatus::kFinished, "", found},
        {"leg-1-adjust",
         "adjustToMarker",
         vda5050::ActionStatus::kFailed,
         "no_marker_in_view",
         {}}};
    state.errors = {{"orderError", false, "not here", {{"orderId", "b"}, {"orderUpdateId", "0"}}}};
    state.brackets = {{"front left", 27000.5, 26900, 0.125}, {"front right", 1, 2}};
    state.wheels = {{"FL", 0.2, 0.31, 33.5, ""}, {"FR", 0.2, 0.31, 61, "overheated"}};
    vda5050::CameraReading seen;
    seen.camera = "front";
    seen.found = true;
    seen.payload = "ST02-F";
    seen.code = {4.51, -0.003};
    seen.angle_rad = 0.02;
    seen.sigma_m = 5e-5;
    seen.rms_px = 0.12;
    vda5050::CameraReading blind;
    blind.camera = "back";
    blind.why_not = "no_code";
    state.cameras = {seen, blind};
    state.parking_feet = {{"left", 0.1, 52300}, {"right", 0.1}};
    state.load_kg = 11000;
    return state;
}

inline plant::VehicleType vehicle_type() {
    plant::VehicleType type;
    type.name = "Tang platform";
    type.footprint = geometry::rectangle(10.5, 2.5);
    type.load_footprint = geometry::rectangle(16, 4);
    type.max_load_kg = 22000;
    type.max_speed_mps = 0.5;
    type.max_accel_mps2 = 0.1;
    type.wheels = {{"FL", {4, 1}, true, true, 0.5}, {"FR", {4, -1}, false, false, 0.5}};
    return type;
}

}  // namespace pulseline::vda5050::testing
