#pragma once

#include <string>

#include "core/fleet/state/job_order.hpp"

/// A leg as JSON text inside a row, as db/json_text.hpp has it.
namespace pulseline::db {

std::string leg_to_json(const fleet::Leg& leg);
fleet::Leg leg_from_json(const std::string& text);

}  // namespace pulseline::db
