#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::vda5050 {

std::string encode_order(const OrderMessage& order, const Header& header);
[[nodiscard]] Result<OrderMessage> decode_order(const Json& payload);

}  // namespace pulseline::vda5050
