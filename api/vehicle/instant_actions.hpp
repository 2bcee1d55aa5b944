#pragma once

#include "api/vehicle/header.hpp"
#include "core/fleet/state/vehicle_messages.hpp"

namespace pulseline::vda5050 {

std::string encode_instant_actions(const fleet::InstantActionsMessage& message,
                                   const Header& header);
[[nodiscard]] Result<fleet::InstantActionsMessage> decode_instant_actions(const Json& payload);

}  // namespace pulseline::vda5050
