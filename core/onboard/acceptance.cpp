#include "core/onboard/acceptance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/angle.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::onboard {
namespace {

using vda5050::OrderMessage;
using vda5050::VehicleError;

// Node and edge end must agree to this, or message and motion contradict each other.
constexpr double kEdgeEnd_m = 0.05;

std::optional<VehicleError> malformed(const OrderMessage& order) {
    const auto error = [&](std::string what) {
        return order_error("validationError", std::move(what), order);
    };
    if (order.order_id.empty()) return error("orderId is empty");
    if (order.nodes.empty()) return error("nodes is empty; an order needs one node at least");
    if (order.edges.size() + 1 != order.nodes.size()) {
        return error("edges must be one fewer than nodes");
    }
    if (!order.nodes.front().released) return error("the first node is not released");
    const std::int64_t first = order.nodes.front().sequence_id;
    if (first < 0 || first % 2 != 0) return error("the first node's sequenceId is not even");
    for (std::size_t i = 0; i < order.nodes.size(); ++i) {
        const auto expected = first + 2 * static_cast<std::int64_t>(i);
        if (order.nodes[i].sequence_id != expected) {
            return error("sequenceId of node " + order.nodes[i].node_id + " must be " +
                         std::to_string(expected));
        }
        if (i == 0) continue;
        const auto& edge = order.edges[i - 1];
        if (edge.sequence_id != expected - 1) {
            return error("sequenceId of edge " + edge.edge_id + " must be " +
                         std::to_string(expected - 1));
        }
        const bool both = order.nodes[i].released && order.nodes[i - 1].released;
        if (order.nodes[i].released && !order.nodes[i - 1].released) {
            return error("node " + order.nodes[i].node_id + " is released behind the horizon");
        }
        if (edge.released != both) {
            return error("edge " + edge.edge_id + " must be released exactly with both its nodes");
        }
        if (distance(edge.segment.end.position(), order.nodes[i].pose.position()) > kEdgeEnd_m) {
            return error("edge " + edge.edge_id + " does not end at node " +
                         order.nodes[i].node_id);
        }
    }
    return std::nullopt;
}

/// What an order asks for on an edge goes on while that is driven: who is to stand meanwhile (SOFT,
/// HARD) cannot do it.
std::optional<VehicleError> unusable_on_edges(const OrderMessage& order) {
    for (const auto& edge : order.edges) {
        for (const auto& action : edge.actions) {
            std::string why_not;
            if (!is_edge_action(action.type)) {
                why_not = "is not supported on an edge";
            } else if (action.blocking != vda5050::BlockingType::kNone) {
                why_not = "is done driving; on an edge its blockingType must be NONE";
            } else if (action.id.empty()) {
                why_not = "lacks its actionId";
            } else {
                continue;
            }
            auto error = order_error("orderError", "action " + action.type + " " + why_not, order);
            error.references.emplace_back("actionId", action.id);
            return error;
        }
    }
    return std::nullopt;
}

std::optional<VehicleError> unusable(const OrderMessage& order, const OrderContext& context) {
    const auto has = [](const std::vector<std::string>& types, const std::string& type) {
        return std::find(types.begin(), types.end(), type) != types.end();
    };
    for (const auto& node : order.nodes) {
        if (node.map_id != context.map_id) {
            auto error = order_error(
                "orderError",
                "map " + node.map_id + " is not on this vehicle; it has " + context.map_id, order);
            error.references.emplace_back("nodeId", node.node_id);
            return error;
        }
        for (const auto& action : node.actions) {
            const bool stops = has(stop_action_types(), action.type);
            const bool can = stops || has(context.node_actions, action.type);
            const bool complete = (!stops || action.stop_target) && !action.id.empty();
            if (can && complete) continue;
            auto error = order_error("orderError",
                                     can ? "action " + action.type + " lacks its actionId or target"
                                         : "action " + action.type + " is not supported at a node",
                                     order);
            error.references.emplace_back("actionId", action.id);
            return error;
        }
    }
    return unusable_on_edges(order);
}

OrderDecision rejected(VehicleError error) {
    return {OrderDecision::Kind::kRejected, std::move(error)};
}

OrderDecision decide_update(const OrderMessage& order, const OrderContext& context) {
    if (order.order_update_id == context.order_update_id) {
        return {OrderDecision::Kind::kDuplicate, {}};
    }
    if (order.order_update_id < context.order_update_id) {
        return rejected(order_error("orderUpdateError",
                                    "orderUpdateId is lower than the running one, " +
                                        std::to_string(context.order_update_id),
                                    order));
    }
    if (context.cancelled) {
        return rejected(
            order_error("orderUpdateError", "the order was cancelled; send a new one", order));
    }
    const auto& first = order.nodes.front();
    if (first.node_id != context.stitch_node_id ||
        first.sequence_id != context.stitch_sequence_id) {
        auto error = order_error("orderUpdateError",
                                 "the update does not begin at the last base node, " +
                                     context.stitch_node_id + " (sequenceId " +
                                     std::to_string(context.stitch_sequence_id) + ")",
                                 order);
        error.references.emplace_back("nodeId", first.node_id);
        return rejected(std::move(error));
    }
    return {OrderDecision::Kind::kUpdate, {}};
}

OrderDecision decide_new(const OrderMessage& order, const OrderContext& context) {
    if (!context.idle || context.cancelling) {
        return rejected(order_error(
            "orderError",
            "order " + context.order_id + " is still active; cancel it or wait for its end",
            order));
    }
    if (order.order_update_id != 0 || order.nodes.front().sequence_id != 0) {
        return rejected(order_error("orderUpdateError",
                                    "an update of an order this vehicle does not know", order));
    }
    if (!context.pose) {
        return rejected(
            order_error("orderError", "the position is not initialised; send initPosition", order));
    }
    const auto& start = order.nodes.front();
    const double off_m = distance(context.pose->position(), start.pose.position());
    const double off_rad = std::abs(wrap(context.pose->heading_rad - start.pose.heading_rad));
    if (off_m > start.allowed_deviation_xy_m ||
        (start.has_heading && off_rad > start.allowed_deviation_theta_rad)) {
        auto error = order_error("noRouteError",
                                 "the first node is " + std::to_string(off_m) + " m and " +
                                     std::to_string(off_rad) + " rad away",
                                 order);
        error.references.emplace_back("nodeId", start.node_id);
        return rejected(std::move(error));
    }
    return {OrderDecision::Kind::kNewOrder, {}};
}

}  // namespace

vda5050::VehicleError order_error(std::string type, std::string description,
                                  const OrderMessage& order) {
    VehicleError error;
    error.type = std::move(type);
    error.description = std::move(description);
    error.references = {{"orderId", order.order_id},
                        {"orderUpdateId", std::to_string(order.order_update_id)}};
    return error;
}

OrderDecision decide_order(const OrderMessage& order, const OrderContext& context) {
    if (auto error = malformed(order)) return rejected(std::move(*error));
    if (context.in_hand) {
        return rejected(order_error("orderError", "the vehicle is driven by hand", order));
    }
    const bool same = !context.order_id.empty() && order.order_id == context.order_id;
    const OrderDecision decision =
        same ? decide_update(order, context) : decide_new(order, context);
    if (decision.kind == OrderDecision::Kind::kNewOrder ||
        decision.kind == OrderDecision::Kind::kUpdate) {
        if (auto error = unusable(order, context)) return rejected(std::move(*error));
    }
    return decision;
}

const std::vector<std::string>& stop_action_types() {
    static const std::vector<std::string> types{vda5050::kAdjustToMarker, vda5050::kMeasureStop};
    return types;
}

const std::vector<std::string>& edge_action_types() {
    static const std::vector<std::string> types{vda5050::kObserveMarkers,
                                                vda5050::kFinePositioning};
    return types;
}

bool is_edge_action(const std::string& type) {
    return std::ranges::find(edge_action_types(), type) != edge_action_types().end();
}

std::vector<std::string> instant_action_types(const plant::VehicleType& type) {
    std::vector<std::string> types{
        vda5050::kCancelOrder,    vda5050::kStartPause,       vda5050::kStopPause,
        vda5050::kStateRequest,   vda5050::kFactsheetRequest, vda5050::kInitPosition,
        vda5050::kAdjustToMarker, vda5050::kMeasureStop,      vda5050::kStopCharging};
    if (!type.receivers.empty()) types.emplace_back(vda5050::kSetTransmitters);
    if (type.navigation_scanner) types.emplace_back(vda5050::kSetReflectors);
    if (!type.brackets.empty()) {
        types.insert(types.end(), {vda5050::kSetBracketHeight, vda5050::kPick, vda5050::kDrop});
    }
    if (type.parking) {
        types.insert(types.end(), {vda5050::kRaiseParking, vda5050::kLowerParking});
    }
    if (!type.brackets.empty() || type.parking) types.emplace_back(vda5050::kStopLifts);
    return types;
}

}  // namespace pulseline::onboard
