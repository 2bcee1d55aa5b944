#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::vda5050 {

std::string encode_connection(ConnectionState state, const Header& header);
[[nodiscard]] Result<ConnectionState> decode_connection(const Json& payload);

}  // namespace pulseline::vda5050
