#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "api/vda5050/hand_held.hpp"
#include "api/vda5050/header.hpp"
#include "core/base/result.hpp"
#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::server {

/// What a vehicle said in one text frame.
struct VehicleFrame {
    vda5050::Topic topic = vda5050::Topic::kState;
    std::string retained;  // payload of the topics that are kept for a vehicle that is away
    std::variant<vda5050::StateMessage, vda5050::VisualizationMessage, vda5050::ConnectionState,
                 vda5050::Factsheet, vda5050::HandAnswerFrame>
        message;
};

/// Reads a frame of this very vehicle; the error's field names what is wrong.
Result<VehicleFrame> read_vehicle_frame(std::string_view text, const plant::Vehicle& vehicle);

}  // namespace pulseline::server
