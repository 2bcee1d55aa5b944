#pragma once

#include "api/vehicle/header.hpp"
#include "core/fleet/state/vehicle_messages.hpp"

namespace pulseline::vda5050 {

/// The header fields of `state` itself are not used.
std::string encode_state(const fleet::StateMessage& state, const Header& header);
[[nodiscard]] Result<fleet::StateMessage> decode_state(const Json& payload);

}  // namespace pulseline::vda5050
