#pragma once

#include "api/vehicle/header.hpp"
#include "core/fleet/state/vehicle_messages.hpp"

namespace pulseline::vda5050 {

std::string encode_visualization(const fleet::VisualizationMessage& message,
                                 const std::string& map_id, const Header& header);
[[nodiscard]] Result<fleet::VisualizationMessage> decode_visualization(const Json& payload);

}  // namespace pulseline::vda5050
