#pragma once

#include "api/vehicle/header.hpp"
#include "core/fleet/state/vehicle_messages.hpp"

namespace pulseline::vda5050 {

std::string encode_connection(fleet::ConnectionState state, const Header& header);
[[nodiscard]] Result<fleet::ConnectionState> decode_connection(const Json& payload);

}  // namespace pulseline::vda5050
