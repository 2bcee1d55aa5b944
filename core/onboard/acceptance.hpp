#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vda5050/messages.hpp"

/// Which orders a vehicle takes (VDA 5050 2.1 section 6.6.4, guide figure 8). Pure functions.
namespace pulseline::onboard {

using geometry::Pose2;

/// What the vehicle knows when an order arrives.
struct OrderContext {
    std::string order_id;  // of the last accepted order; empty: none
    std::int64_t order_update_id = 0;
    bool idle = true;        // nothing left to drive or to do
    bool cancelled = false;  // that order was cancelled, or is being cancelled
    bool cancelling = false;
    bool in_hand = false;        // somebody drives it with a hand-held control
    std::string stitch_node_id;  // last node of the base
    std::int64_t stitch_sequence_id = 0;
    std::optional<Pose2> pose;  // believed; nullopt while it is not initialised
    std::string map_id;
    std::vector<std::string> node_actions;  // that it runs besides measuring
};

struct OrderDecision {
    enum class Kind { kNewOrder, kUpdate, kDuplicate, kRejected };
    Kind kind = Kind::kRejected;
    vda5050::VehicleError error;  // when rejected
};

OrderDecision decide_order(const vda5050::OrderMessage& order, const OrderContext& context);

/// Types of action a vehicle runs at a node, on an edge, and as instant actions. The first need a
/// target.
const std::vector<std::string>& stop_action_types();
const std::vector<std::string>& edge_action_types();
bool is_edge_action(const std::string& type);
std::vector<std::string> instant_action_types(const plant::VehicleType& type);

vda5050::VehicleError order_error(std::string type, std::string description,
                                  const vda5050::OrderMessage& order);

}  // namespace pulseline::onboard
