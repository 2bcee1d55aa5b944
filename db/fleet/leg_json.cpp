#include "db/fleet/leg_json.hpp"

#include <nlohmann/json.hpp>

#include "db/error.hpp"
#include "db/json_number.hpp"
#include "db/json_text.hpp"
#include "db/names.hpp"

namespace pulseline::db {
namespace {

using Json = OrderedJson;
using fleet::Leg;
using geometry::Pose2;
using kinematics::Segment;
using vda5050::Action;
using vda5050::OrderEdge;
using vda5050::OrderNode;
using vda5050::StopTarget;

Json number(double value) { return finite(value, "a number of a leg"); }

Json encode(const Pose2& p) {
    return Json::array({number(p.x_m), number(p.y_m), number(p.heading_rad)});
}
Pose2 decode_pose(const Json& j) { return {j.at(0), j.at(1), j.at(2)}; }

Json encode(const StopTarget& t) {
    Json markers = Json::array();
    for (const auto& m : t.markers) {
        markers.push_back({{"payload", m.payload},
                           {"kind", m.kind},
                           {"size_m", number(m.size_m)},
                           {"pose", encode(m.pose)},
                           {"sigma_m", number(m.sigma_m)},
                           {"sigma_rad", number(m.sigma_rad)}});
    }
    return {{"station", t.station_id},
            {"number", t.station_number},
            {"target", encode(t.target)},
            {"tolerance", Json::array({number(t.tolerance_x_m), number(t.tolerance_y_m),
                                       number(t.tolerance_heading_rad)})},
            {"markers", std::move(markers)}};
}

StopTarget decode_stop_target(const Json& j) {
    StopTarget t;
    t.station_id = j.at("station");
    t.station_number = whole<int>(j.at("number"));
    t.target = decode_pose(j.at("target"));
    t.tolerance_x_m = j.at("tolerance").at(0);
    t.tolerance_y_m = j.at("tolerance").at(1);
    t.tolerance_heading_rad = j.at("tolerance").at(2);
    for (const Json& m : j.at("markers")) {
        t.markers.push_back({m.at("payload"), m.at("kind"), m.at("size_m"),
                             decode_pose(m.at("pose")), m.at("sigma_m"),
                             m.value("sigma_rad", 0.0)});
    }
    return t;
}

Json encode(const Action& a) {
    Json json = {{"type", a.type},
                 {"id", a.id},
                 {"blocking", static_cast<int>(a.blocking)},
                 {"params", params_json(a.params)}};
    if (a.stop_target) json["stop_target"] = encode(*a.stop_target);
    if (a.init_position) {
        json["init_position"] = {{"pose", encode(a.init_position->pose)},
                                 {"map", a.init_position->map_id},
                                 {"node", a.init_position->last_node_id}};
    }
    return json;
}

Action decode_action(const Json& j) {
    Action a;
    a.type = j.at("type");
    a.id = j.at("id");
    a.blocking = enumerator(j.at("blocking"), vda5050::BlockingType::kHard);
    a.params = params_of(j.at("params"));
    if (j.contains("stop_target")) a.stop_target = decode_stop_target(j.at("stop_target"));
    if (j.contains("init_position")) {
        const Json& p = j.at("init_position");
        a.init_position =
            vda5050::InitPosition{decode_pose(p.at("pose")), p.at("map"), p.at("node")};
    }
    return a;
}

Json encode(const OrderNode& n) {
    Json actions = Json::array();
    for (const Action& a : n.actions) actions.push_back(encode(a));
    return {{"id", n.node_id},
            {"seq", n.sequence_id},
            {"released", n.released},
            {"pose", encode(n.pose)},
            {"has_heading", n.has_heading},
            {"deviation_xy", number(n.allowed_deviation_xy_m)},
            {"deviation_theta", number(n.allowed_deviation_theta_rad)},
            {"map", n.map_id},
            {"actions", std::move(actions)}};
}

OrderNode decode_node(const Json& j) {
    OrderNode n;
    n.node_id = j.at("id");
    n.sequence_id = whole<decltype(n.sequence_id)>(j.at("seq"));
    n.released = j.at("released");
    n.pose = decode_pose(j.at("pose"));
    n.has_heading = j.at("has_heading");
    n.allowed_deviation_xy_m = j.at("deviation_xy");
    n.allowed_deviation_theta_rad = j.at("deviation_theta");
    n.map_id = j.at("map");
    for (const Json& a : j.at("actions")) n.actions.push_back(decode_action(a));
    return n;
}

Json encode(const Segment& s) {
    return {{"kind", static_cast<int>(s.kind)},
            {"start", encode(s.start)},
            {"end", encode(s.end)},
            {"turn", number(s.turn_rad)},
            {"length", number(s.length_m)},
            {"direction", number(s.direction_rad)},
            {"centre", Json::array({number(s.centre.x_m), number(s.centre.y_m)})},
            {"duration", number(s.duration_s)}};
}

Segment decode_segment(const Json& j) {
    Segment s;
    s.kind = enumerator(j.at("kind"), Segment::Kind::kCombined);
    s.start = decode_pose(j.at("start"));
    s.end = decode_pose(j.at("end"));
    s.turn_rad = j.at("turn");
    s.length_m = j.at("length");
    s.direction_rad = j.at("direction");
    s.centre = {j.at("centre").at(0), j.at("centre").at(1)};
    s.duration_s = j.at("duration");
    return s;
}

Json encode(const OrderEdge& e) {
    Json json{{"id", e.edge_id},
              {"seq", e.sequence_id},
              {"released", e.released},
              {"segment", encode(e.segment)},
              {"max_speed", number(e.max_speed_mps)}};
    if (e.corridor) {
        json["corridor"] = {{"left", number(e.corridor->left_m)},
                            {"right", number(e.corridor->right_m)}};
    }
    return json;
}

OrderEdge decode_edge(const Json& j) {
    OrderEdge edge{j.at("id"), whole<decltype(OrderEdge::sequence_id)>(j.at("seq")),
                   j.at("released"), decode_segment(j.at("segment")), j.at("max_speed")};
    if (const auto corridor = j.find("corridor"); corridor != j.end()) {
        edge.corridor = {corridor->at("left"), corridor->at("right")};
    }
    return edge;
}

Leg decode_leg(const Json& j) {
    Leg leg;
    read_id(j.at("id"), leg.id);
    read_id(j.at("order"), leg.order);
    leg.step = whole<int>(j.at("step"));
    leg.vehicle = plant::VehicleId(j.at("vehicle"));
    leg.station = plant::StationId(j.at("station"));
    read(j.at("mode").get<std::string>(), leg.mode);
    leg.hall = j.at("hall");
    leg.update_id = whole<std::int64_t>(j.at("update"));
    for (const Json& n : j.at("nodes")) leg.nodes.push_back(decode_node(n));
    for (const Json& e : j.at("edges")) leg.edges.push_back(decode_edge(e));
    leg.released_nodes = whole<std::size_t>(j.at("released_nodes"));
    leg.passed_nodes = whole<std::size_t>(j.at("passed_nodes"));
    leg.duration_s = j.at("duration");
    leg.attempt = whole<int>(j.at("attempt"));
    leg.actions_only = j.value("actions_only", false);  // older rows do not say
    leg.charges = j.value("charges", false);
    // The fleet relies on it when it looks up nodes and edges. A vehicle may say that it has passed
    // more than was released.
    const auto counts = [&](std::size_t nodes) { return nodes >= 1 && nodes <= leg.nodes.size(); };
    if (leg.step < 0 || leg.edges.size() + 1 != leg.nodes.size() || !counts(leg.released_nodes) ||
        !counts(leg.passed_nodes)) {
        throw Error(Error::Kind::kBadValue, "The database holds a damaged leg; restore a backup.");
    }
    return leg;
}

}  // namespace

std::string leg_to_json(const Leg& leg) {
    Json nodes = Json::array();
    for (const OrderNode& n : leg.nodes) nodes.push_back(encode(n));
    Json edges = Json::array();
    for (const OrderEdge& e : leg.edges) edges.push_back(encode(e));
    return text_of({{"id", stored_id(leg.id)},
                    {"order", stored_id(leg.order)},
                    {"step", leg.step},
                    {"vehicle", leg.vehicle.str()},
                    {"station", leg.station.str()},
                    {"mode", plant::to_string(leg.mode)},
                    {"hall", leg.hall},
                    {"update", leg.update_id},
                    {"nodes", std::move(nodes)},
                    {"edges", std::move(edges)},
                    {"released_nodes", leg.released_nodes},
                    {"passed_nodes", leg.passed_nodes},
                    {"duration", number(leg.duration_s)},
                    {"attempt", leg.attempt},
                    {"actions_only", leg.actions_only},
                    {"charges", leg.charges}});
}

Leg leg_from_json(const std::string& text) {
    return decoded(text, [](const Json& json) { return decode_leg(json); });
}

}  // namespace pulseline::db
