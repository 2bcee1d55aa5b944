#include "server/vehicles/vehicle_frames.hpp"

#include "api/vda5050/connection.hpp"
#include "api/vda5050/factsheet.hpp"
#include "api/vda5050/frame.hpp"
#include "api/vda5050/state.hpp"
#include "api/vda5050/visualization.hpp"

namespace pulseline::server {
namespace {

using vda5050::Topic;

template <class T>
Result<VehicleFrame> made(VehicleFrame frame, Result<T> message) {
    if (!message) return fail(message.error());
    frame.message = std::move(*message);
    return frame;
}

}  // namespace

Result<VehicleFrame> read_vehicle_frame(std::string_view text, const plant::Vehicle& vehicle) {
    const auto frame = vda5050::decode_frame(text);
    if (!frame) return fail(frame.error());
    const auto header = vda5050::decode_header(frame->payload);
    if (!header) return fail(header.error());
    if (header->manufacturer != vehicle.manufacturer ||
        header->serial_number != vehicle.serial_number) {
        return fail(Errc::kForbidden, "wrong_identity",
                    "The message names another vehicle than the one this socket belongs to.",
                    "/payload/serialNumber");
    }
    VehicleFrame out;
    out.topic = frame->topic;
    switch (frame->topic) {
        case Topic::kState:
            return made(std::move(out), vda5050::decode_state(frame->payload));
        case Topic::kVisualization:
            return made(std::move(out), vda5050::decode_visualization(frame->payload));
        case Topic::kConnection:
            out.retained = vda5050::print(frame->payload);
            return made(std::move(out), vda5050::decode_connection(frame->payload));
        case Topic::kFactsheet:
            out.retained = vda5050::print(frame->payload);
            return made(std::move(out), vda5050::decode_factsheet(frame->payload));
        case Topic::kHandHeld:
            return made(std::move(out), vda5050::decode_hand_answer(frame->payload));
        case Topic::kOrder:
        case Topic::kInstantActions:
            break;
    }
    return fail(Errc::kInvalid, "wrong_topic",
                std::string("A vehicle does not send on the topic ") + to_string(frame->topic) +
                    "; send state, visualization, connection, factsheet or handHeld.",
                "/topic");
}

}  // namespace pulseline::server
