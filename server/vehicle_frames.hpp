#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/fleet/vehicle_messages.hpp"
#include "core/plant/plant.hpp"

/// Frames of the vehicle link as the gateway needs them, over the codecs of api/vehicle.
namespace pulseline::server {

struct DecodedFrame {
    std::string topic;
    bool retain = false;
    std::string payload;  // as JSON text when it is retained
    std::variant<fleet::StateMessage, fleet::VisualizationMessage, fleet::ConnectionState,
                 fleet::Factsheet>
        message;
};
/// A frame of this very vehicle; the error's field names what is wrong.
Result<DecodedFrame> decode_frame(std::string_view frame, const plant::Vehicle& vehicle);

struct Picture {
    std::string camera;
    std::string mime;
    std::string_view bytes;  // within the frame
};
Result<Picture> decode_picture(std::string_view frame);

std::string encode_order(const fleet::OrderMessage& order, const plant::Vehicle& vehicle,
                         std::int64_t header_id, Time now);
std::string encode_actions(const fleet::InstantActionsMessage& actions,
                           const plant::Vehicle& vehicle, std::int64_t header_id, Time now);
/// Payload of a connection message.
std::string encode_connection(const char* state, const plant::Vehicle& vehicle, Time now);

}  // namespace pulseline::server
