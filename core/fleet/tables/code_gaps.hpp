#pragma once

#include <vector>

#include "core/fleet/tables/floor_graph.hpp"

namespace pulseline::fleet {

constexpr const char* kCodeGap = "code_gap";

/// Lanes on which vehicles of a class lose themselves: wherever they come from and go to, they
/// drive farther without a code than they may to catch the next one (localisation::blind_way_m). At
/// most one reason a class, code_gap {class, at_most_m, at_x_m, at_y_m, count, blind_m?}: the worst
/// one and its middle, where a code helps, and on how many pieces of lanes it is so; without
/// blind_m they pass no code at all. Classes without cameras have none, and
/// nobody drives on lanes that no station leads to.
std::vector<Reason> check_codes(const plant::Plant& plant, const std::vector<FloorClass>& classes);

}  // namespace pulseline::fleet
