#pragma once

#include "api/vehicle/header.hpp"
#include "core/fleet/state/vehicle_messages.hpp"

namespace pulseline::vda5050 {

std::string encode_order(const fleet::OrderMessage& order, const Header& header);
[[nodiscard]] Result<fleet::OrderMessage> decode_order(const Json& payload);

}  // namespace pulseline::vda5050
