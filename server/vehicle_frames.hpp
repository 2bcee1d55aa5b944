#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "api/vehicle/header.hpp"
#include "core/base/result.hpp"
#include "core/fleet/state/vehicle_messages.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::server {

/// What a vehicle said in one text frame.
struct VehicleFrame {
    vda5050::Topic topic = vda5050::Topic::kState;
    std::string retained;  // payload of the topics that are kept for a vehicle that is away
    std::variant<fleet::StateMessage, fleet::VisualizationMessage, fleet::ConnectionState,
                 fleet::Factsheet>
        message;
};

/// Reads a frame of this very vehicle; the error's field names what is wrong.
Result<VehicleFrame> read_vehicle_frame(std::string_view text, const plant::Vehicle& vehicle);

}  // namespace pulseline::server
