#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::vda5050 {

/// An action of an order or an instant action. Our own ones carry their target as parameters with
/// object values, as 2.1 allows.
Json encode_action(const Action& action);
Action decode_action(const Json& value, const std::string& pointer, json::FieldErrors& errors);

/// resultDescription of measureStop and adjustToMarker.
std::string encode_measurement(const StopMeasurement& measurement);
[[nodiscard]] Result<StopMeasurement> decode_measurement(std::string_view text);

}  // namespace pulseline::vda5050
