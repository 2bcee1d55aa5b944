#pragma once

#include <vector>

#include "core/fleet/tables/floor_graph.hpp"

namespace pulseline::fleet {

constexpr const char* kLightGap = "light_gap";

/// Lanes and stations where the light of iGPS tells no pose (localisation::expected_fix), of
/// classes that have receivers and no camera. At most one reason a class, light_gap {class, at_x_m,
/// at_y_m, why, count}: the first such place, its reason code, and at how many it is so.
std::vector<Reason> check_light(const plant::Plant& plant, const std::vector<FloorClass>& classes);

}  // namespace pulseline::fleet
