#pragma once

#include <optional>
#include <vector>

#include "api/http/common_json.hpp"
#include "core/fleet/ports.hpp"
#include "core/fleet/views.hpp"

namespace pulseline::api {

/// What a mode comes to, or the reason against it (ModeOption).
Json mode_option_json(const planning::ModeOption& option);

/// `expected` has one entry a step: what earlier stops in the chosen mode came to, if there are
/// any.
Json preview_json(const fleet::Preview& preview,
                  const std::vector<std::optional<fleet::StopStatistics>>& expected);

}  // namespace pulseline::api
