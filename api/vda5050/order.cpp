#include "api/vda5050/order.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "api/vda5050/action.hpp"
#include "api/vda5050/limits.hpp"
#include "api/vda5050/motion.hpp"

namespace pulseline::vda5050 {
namespace {

constexpr std::size_t kMaxNodes = 2000;
constexpr json::IntegerLimits kSequence{0, std::numeric_limits<std::int32_t>::max()};

Json encode_actions(const std::vector<Action>& actions) {
    Json list = Json::array();
    for (const auto& action : actions) list.push_back(encode_action(action));
    return list;
}

Json encode_node(const OrderNode& node) {
    Json position{{"x", finite(node.pose.x_m)},
                  {"y", finite(node.pose.y_m)},
                  {"allowedDeviationXY", finite(node.allowed_deviation_xy_m)},
                  {"mapId", node.map_id}};
    if (node.has_heading) {
        position["theta"] =
            std::clamp(wrap(finite(node.pose.heading_rad)), -limits::kSchemaPi, limits::kSchemaPi);
        position["allowedDeviationTheta"] = finite(node.allowed_deviation_theta_rad);
    }
    return {{"nodeId", node.node_id},
            {"sequenceId", node.sequence_id},
            {"released", node.released},
            {"nodePosition", std::move(position)},
            {"actions", encode_actions(node.actions)}};
}

Json encode_edge(const OrderEdge& edge, const OrderNode& from, const OrderNode& to) {
    Json out{{"edgeId", edge.edge_id},    {"sequenceId", edge.sequence_id},
             {"released", edge.released}, {"startNodeId", from.node_id},
             {"endNodeId", to.node_id},   {"actions", encode_actions(edge.actions)}};
    if (edge.max_speed_mps > 0) out["maxSpeed"] = finite(edge.max_speed_mps);
    if (edge.corridor) {
        out["corridor"] = {{"leftWidth", finite(edge.corridor->left_m)},
                           {"rightWidth", finite(edge.corridor->right_m)},
                           {"corridorRefPoint", "CONTOUR"}};
    }
    encode_motion(out, edge.segment);
    return out;
}

/// Boundaries for the centre alone say nothing of the room for the body: that is none to us.
std::optional<plant::Corridor> decode_corridor(json::ObjectReader& edge) {
    if (!edge.has("corridor")) return std::nullopt;
    auto in = edge.object("corridor");
    const plant::Corridor corridor{in.number("leftWidth", limits::kLength_m),
                                   in.number("rightWidth", limits::kLength_m)};
    const auto about = in.text_or("corridorRefPoint", "KINEMATICCENTER", {0, 32});
    if (about != "CONTOUR") return std::nullopt;
    return corridor;
}

OrderNode decode_node(const Json& value, const std::string& pointer, json::FieldErrors& errors) {
    json::ObjectReader in(value, pointer, errors);
    OrderNode node;
    node.node_id = in.text("nodeId", {1, 200});
    node.sequence_id = in.integer("sequenceId", kSequence);
    node.released = in.boolean("released");
    auto position = in.object("nodePosition");
    node.pose.x_m = position.number("x", limits::kPlace_m);
    node.pose.y_m = position.number("y", limits::kPlace_m);
    node.has_heading = position.has("theta");
    node.pose.heading_rad = position.number_or("theta", 0, {-3.2, 3.2});
    node.allowed_deviation_xy_m =
        position.number_or("allowedDeviationXY", node.allowed_deviation_xy_m, limits::kLength_m);
    node.allowed_deviation_theta_rad =
        position.number_or("allowedDeviationTheta", node.allowed_deviation_theta_rad, {-3.2, 3.2});
    node.map_id = position.text("mapId", {1, 200});
    in.items("actions", {0, 100}, [&](const Json& item, const std::string& at) {
        node.actions.push_back(decode_action(item, at, errors));
    });
    return node;
}

OrderEdge decode_edge(const Json& value, const std::string& pointer, const OrderNode& from,
                      const OrderNode& to, json::FieldErrors& errors) {
    json::ObjectReader in(value, pointer, errors);
    OrderEdge edge;
    edge.edge_id = in.text("edgeId", {1, 200});
    edge.sequence_id = in.integer("sequenceId", kSequence);
    edge.released = in.boolean("released");
    edge.max_speed_mps = in.number_or("maxSpeed", 0, limits::kSpeed_mps);
    edge.corridor = decode_corridor(in);
    in.items("actions", {0, 100}, [&](const Json& item, const std::string& at) {
        edge.actions.push_back(decode_action(item, at, errors));
    });
    if (errors.empty()) edge.segment = decode_motion(in, from, to);
    return edge;
}

}  // namespace

std::string encode_order(const OrderMessage& order, const Header& header) {
    Json message = begin_message(header);
    message["orderId"] = order.order_id;
    message["orderUpdateId"] = order.order_update_id;
    message["nodes"] = Json::array();
    message["edges"] = Json::array();
    for (const auto& node : order.nodes) message["nodes"].push_back(encode_node(node));
    for (std::size_t i = 0; i < order.edges.size(); ++i) {
        message["edges"].push_back(encode_edge(order.edges[i], order.nodes[i], order.nodes[i + 1]));
    }
    return print(message);
}

Result<OrderMessage> decode_order(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    OrderMessage order;
    order.order_id = in.text("orderId", {1, 200});
    order.order_update_id = in.integer("orderUpdateId", kSequence);
    in.items("nodes", {1, kMaxNodes}, [&](const Json& item, const std::string& at) {
        order.nodes.push_back(decode_node(item, at, errors));
    });
    in.items("edges", {0, kMaxNodes}, [&](const Json& item, const std::string& at) {
        const std::size_t i = order.edges.size();
        if (i + 1 >= order.nodes.size()) {
            errors.add(at, {"too_many_edges", {}}, "edges must be one fewer than nodes");
            return;
        }
        order.edges.push_back(decode_edge(item, at, order.nodes[i], order.nodes[i + 1], errors));
    });
    if (auto status = errors.status(); !status) return fail(status.error());
    return order;
}

}  // namespace pulseline::vda5050
