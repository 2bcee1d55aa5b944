#pragma once

#include <vector>

#include "core/fleet/tables/floor_graph.hpp"

namespace pulseline::fleet {

constexpr const char* kCodesTooFast = "codes_too_fast";

/// Classes whose cameras read no code of the plant surely at the class's own top speed
/// (localisation::reading_speed_mps): codes_too_fast {class, speed_mps, max_speed_mps}, the speed
/// of the code that they read best. They are slowed down over every code that their way relies on.
std::vector<Reason> check_code_speeds(const plant::Plant& plant,
                                      const std::vector<FloorClass>& classes);

}  // namespace pulseline::fleet
