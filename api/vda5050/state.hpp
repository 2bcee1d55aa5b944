#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::vda5050 {

/// The header fields of `state` itself are not used.
std::string encode_state(const StateMessage& state, const Header& header);
[[nodiscard]] Result<StateMessage> decode_state(const Json& payload);

}  // namespace pulseline::vda5050
