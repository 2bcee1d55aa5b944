#pragma once

#include <optional>
#include <string_view>

#include "api/json/parse.hpp"

namespace pulseline::json {

/// The value that parse_json gives, in half of the time for a vehicle's report, or nothing as soon
/// as anything is wrong with the text: parse_json then finds out what. Never throws on any text.
[[nodiscard]] std::optional<Json> parse_quickly(std::string_view text, JsonLimits limits);

}  // namespace pulseline::json
