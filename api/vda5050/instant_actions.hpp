#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::vda5050 {

std::string encode_instant_actions(const InstantActionsMessage& message, const Header& header);
[[nodiscard]] Result<InstantActionsMessage> decode_instant_actions(const Json& payload);

}  // namespace pulseline::vda5050
