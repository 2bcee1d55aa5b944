#pragma once

#include <optional>
#include <string>

#include "core/fleet/state/fleet_state.hpp"

/// A request that is sent again, under the same key, makes nothing a second time.
namespace pulseline::fleet {

/// The order that this request made before; nullopt: it is new, or names no key.
/// Errors: idempotency_key_reused.
Result<std::optional<JobOrder>> earlier_answer(const FleetState& fleet, const std::string& client,
                                               const std::string& key,
                                               const std::string& body_sha256);
/// Keeps what the request made, so that it can be answered again for a week.
void keep_answer(FleetState& fleet, const IdempotencyRecord& record);

}  // namespace pulseline::fleet
