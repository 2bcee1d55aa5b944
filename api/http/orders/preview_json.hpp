#pragma once

#include <map>
#include <optional>
#include <vector>

#include "api/http/wire/common_json.hpp"
#include "core/fleet/state/ports.hpp"
#include "core/fleet/state/views.hpp"

namespace pulseline::api {

/// A vehicle's newest arrivals of each mode, of which it is known what was usual.
using Arrivals = std::map<plant::MotionMode, std::vector<kinematics::ArrivalMiss>>;
Arrivals arrivals_of(fleet::History& history, const plant::VehicleId& vehicle);

/// What a mode comes to for a vehicle of these arrivals, or the reason against it (ModeOption).
Json mode_option_json(const planning::ModeOption& option, const Arrivals& arrivals = {});

/// `expected` has one entry a step: what earlier stops in the chosen mode came to, if there are
/// any.
Json preview_json(const fleet::Preview& preview,
                  const std::vector<std::optional<fleet::StopStatistics>>& expected,
                  const Arrivals& arrivals);

}  // namespace pulseline::api
