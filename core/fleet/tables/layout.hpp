#pragma once

#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::fleet {

/// What stands in the way of traffic's guarantee that every order can always be served (see
/// traffic/layout_check.hpp): reasons unreachable {class, from, to, count, crossing?} and
/// too_few_resting_places {class, resting_places, vehicles}, with the stations' names. And where
/// vehicles would lose themselves (code_gaps.hpp, light_gaps.hpp) or drive too fast to read codes
/// (code_speeds.hpp).
std::vector<Reason> check_layout(const plant::Plant& plant);

}  // namespace pulseline::fleet
