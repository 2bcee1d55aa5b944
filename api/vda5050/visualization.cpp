#include "api/vda5050/visualization.hpp"

#include "api/vda5050/pose.hpp"

namespace pulseline::vda5050 {

std::string encode_visualization(const VisualizationMessage& message, const std::string& map_id,
                                 const Header& header) {
    Json out = begin_message(header);
    out["agvPosition"] = encode_position(message.pose, message.position_initialized, map_id);
    out["velocity"] = encode_velocity(message.velocity_mps, message.turn_rate_radps);
    return print(out);
}

Result<VisualizationMessage> decode_visualization(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    VisualizationMessage message;
    auto position = in.object("agvPosition");
    message.pose = decode_position(position);
    message.position_initialized = position.boolean("positionInitialized");
    const Velocity velocity = decode_velocity(in);
    message.velocity_mps = velocity.velocity_mps;
    message.turn_rate_radps = velocity.turn_rate_radps;
    if (auto status = errors.status(); !status) return fail(status.error());
    return message;
}

}  // namespace pulseline::vda5050
