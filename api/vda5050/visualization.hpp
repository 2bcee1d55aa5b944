#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::vda5050 {

std::string encode_visualization(const VisualizationMessage& message, const std::string& map_id,
                                 const Header& header);
[[nodiscard]] Result<VisualizationMessage> decode_visualization(const Json& payload);

}  // namespace pulseline::vda5050
