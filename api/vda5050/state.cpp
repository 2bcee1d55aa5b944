#include "api/vda5050/state.hpp"

#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "api/json/utf8.hpp"
#include "api/vda5050/action.hpp"
#include "api/vda5050/information.hpp"
#include "api/vda5050/limits.hpp"
#include "api/vda5050/pose.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::vda5050 {

// Beside the type, so that the reader finds it.
static const char* to_string(ActionStatus status) {
    switch (status) {
        case ActionStatus::kWaiting:
            return "WAITING";
        case ActionStatus::kInitializing:
            return "INITIALIZING";
        case ActionStatus::kRunning:
            return "RUNNING";
        case ActionStatus::kPaused:
            return "PAUSED";
        case ActionStatus::kFinished:
            return "FINISHED";
        case ActionStatus::kFailed:
            return "FAILED";
    }
    return "";
}

namespace {

constexpr json::IntegerLimits kId{0, std::numeric_limits<std::uint32_t>::max()};
constexpr json::CountLimits kMany{0, 2000};
constexpr std::size_t kText = 4000;
constexpr std::size_t kName = 200;
constexpr std::size_t kReference = 1000;

/// A choice kept as text, for one_of().
struct Word {
    const char* text = "";
};
const char* to_string(Word word) { return word.text; }

Json encode_places(const std::vector<NodeState>& places, const char* id) {
    Json list = Json::array();
    for (const auto& place : places) {
        list.push_back(
            {{id, place.node_id}, {"sequenceId", place.sequence_id}, {"released", place.released}});
    }
    return list;
}

Json encode_action_state(const ActionState& state) {
    Json out{{"actionId", state.id},
             {"actionType", state.type},
             {"actionStatus", to_string(state.status)}};
    if (state.measurement) {
        out["resultDescription"] = encode_measurement(*state.measurement);
    } else if (!state.result_description.empty()) {
        out["resultDescription"] = json::printable(state.result_description, kText);
    }
    return out;
}

Json encode_error(const VehicleError& error) {
    Json references = Json::array();
    for (const auto& [key, value] : error.references) {
        references.push_back(
            {{"referenceKey", key}, {"referenceValue", json::printable(value, kReference)}});
    }
    return {{"errorType", error.type},
            {"errorLevel", error.fatal ? "FATAL" : "WARNING"},
            {"errorDescription", json::printable(error.description, kText)},
            {"errorReferences", std::move(references)}};
}

std::vector<NodeState> decode_places(json::ObjectReader& in, const char* name, const char* id) {
    std::vector<NodeState> places;
    in.items(name, kMany, [&](const Json& item, const std::string& at) {
        json::ObjectReader place(item, at, in.errors());
        places.push_back({place.text(id, {0, 200}), place.integer("sequenceId", kId),
                          place.boolean("released")});
    });
    return places;
}

ActionState decode_action_state(const Json& item, const std::string& at,
                                json::FieldErrors& errors) {
    json::ObjectReader in(item, at, errors);
    ActionState state;
    state.id = in.text("actionId", {0, 200});
    state.type = in.text_or("actionType", "", {0, 200});
    state.status = in.one_of("actionStatus", {ActionStatus::kWaiting, ActionStatus::kInitializing,
                                              ActionStatus::kRunning, ActionStatus::kPaused,
                                              ActionStatus::kFinished, ActionStatus::kFailed});
    state.result_description = in.printable_or("resultDescription", "", kText);
    const bool measures = state.type == kMeasureStop || state.type == kAdjustToMarker;
    if (measures && state.status == ActionStatus::kFinished) {
        // A measurement that cannot be one fails the stop and not the message: the vehicle would
        // send it again with every state. Text of another vehicle is kept as it is.
        if (auto found = decode_measurement(state.result_description)) {
            state.measurement = std::move(*found);
        } else if (!found.error().field.empty()) {
            state.result_description = found.error().field + ": " + found.error().what;
        }
    }
    return state;
}

VehicleError decode_error(const Json& item, const std::string& at, json::FieldErrors& errors) {
    json::ObjectReader in(item, at, errors);
    VehicleError error;
    error.type = in.printable("errorType", kName);
    error.fatal =
        std::string_view(in.one_of("errorLevel", {Word{"WARNING"}, Word{"FATAL"}}).text) == "FATAL";
    error.description = in.printable_or("errorDescription", "", kText);
    in.items_if_any("errorReferences", {0, 100}, [&](const Json& ref, const std::string& where) {
        json::ObjectReader reference(ref, where, errors);
        std::string key = reference.printable("referenceKey", kName);
        error.references.emplace_back(std::move(key),
                                      reference.printable("referenceValue", kReference));
    });
    return error;
}

void decode_body(json::ObjectReader& in, StateMessage& state) {
    if (auto position = in.object_if_any("agvPosition")) {
        state.pose = decode_position(*position);
        state.map_id = position->text("mapId", {0, 200});
        state.position_initialized = position->boolean("positionInitialized");
        state.localization_score = position->number_or("localizationScore", 0, limits::kShare);
        state.deviation_range_m = position->number_or("deviationRange", 0, limits::kDeviation_m);
    }
    const Velocity velocity = decode_velocity(in);
    state.velocity_mps = velocity.velocity_mps;
    state.turn_rate_radps = velocity.turn_rate_radps;
    auto battery = in.object("batteryState");
    state.battery_percent = battery.number("batteryCharge", limits::kPercent);
    state.charging = battery.boolean("charging");
    auto safety = in.object("safetyState");
    state.e_stop =
        safety.one_of("eStop", {Word{"NONE"}, Word{"AUTOACK"}, Word{"MANUAL"}, Word{"REMOTE"}})
            .text;
    state.field_violation = safety.boolean("fieldViolation");
}

}  // namespace

std::string encode_state(const StateMessage& state, const Header& header) {
    Json out = begin_message(header);
    out["orderId"] = state.order_id;
    out["orderUpdateId"] = state.order_update_id;
    out["lastNodeId"] = state.last_node_id;
    out["lastNodeSequenceId"] = state.last_node_sequence_id;
    out["nodeStates"] = encode_places(state.node_states, "nodeId");
    out["edgeStates"] = encode_places(state.edge_states, "edgeId");
    out["driving"] = state.driving;
    out["paused"] = state.paused;
    out["newBaseRequest"] = state.new_base_request;
    out["distanceSinceLastNode"] = finite(state.distance_since_last_node_m);
    out["operatingMode"] = state.operating_mode;
    if (state.pose) {
        Json position = encode_position(*state.pose, state.position_initialized, state.map_id);
        position["localizationScore"] = finite(state.localization_score);
        position["deviationRange"] = finite(state.deviation_range_m);
        out["agvPosition"] = std::move(position);
    }
    out["velocity"] = encode_velocity(state.velocity_mps, state.turn_rate_radps);
    out["batteryState"] = {{"batteryCharge", finite(state.battery_percent)},
                           {"charging", state.charging}};
    out["safetyState"] = {{"eStop", state.e_stop}, {"fieldViolation", state.field_violation}};
    out["actionStates"] = Json::array();
    for (const auto& action : state.action_states) {
        out["actionStates"].push_back(encode_action_state(action));
    }
    out["errors"] = Json::array();
    for (const auto& error : state.errors) out["errors"].push_back(encode_error(error));
    out["information"] = encode_information(state);
    return print(out);
}

Result<StateMessage> decode_state(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    StateMessage state;
    state.header_id = in.integer("headerId", kId);
    state.timestamp = in.text("timestamp", {0, 64});
    state.order_id = in.text("orderId", {0, 200});
    state.order_update_id = in.integer("orderUpdateId", kId);
    state.last_node_id = in.text("lastNodeId", {0, 200});
    state.last_node_sequence_id = in.integer("lastNodeSequenceId", kId);
    state.node_states = decode_places(in, "nodeStates", "nodeId");
    state.edge_states = decode_places(in, "edgeStates", "edgeId");
    state.driving = in.boolean("driving");
    state.paused = in.boolean_or("paused", false);
    state.new_base_request = in.boolean_or("newBaseRequest", false);
    state.distance_since_last_node_m =
        in.number_or("distanceSinceLastNode", 0, limits::kDistance_m);
    state.operating_mode =
        in.one_of("operatingMode", {Word{"AUTOMATIC"}, Word{"SEMIAUTOMATIC"}, Word{"MANUAL"},
                                    Word{"SERVICE"}, Word{"TEACHIN"}})
            .text;
    decode_body(in, state);
    in.items("actionStates", kMany, [&](const Json& item, const std::string& at) {
        state.action_states.push_back(decode_action_state(item, at, errors));
    });
    in.items("errors", kMany, [&](const Json& item, const std::string& at) {
        state.errors.push_back(decode_error(item, at, errors));
    });
    decode_information(in, state);
    if (auto status = errors.status(); !status) return fail(status.error());
    return state;
}

}  // namespace pulseline::vda5050
