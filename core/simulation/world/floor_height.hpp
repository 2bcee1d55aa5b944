#pragma once

#include <functional>
#include <optional>

#include "core/geometry/pose2.hpp"

namespace pulseline::simulation {

/// Height in m of a hall's floor at a place of it; nothing: there is no floor, as over a pit.
using FloorHeight = std::function<std::optional<double>(geometry::Point2 hall)>;

/// Of a floor that is no worse than it should be: long waves of 2 mm, so that two places 4 m apart
/// differ by less than half of what DIN 18202, table 3, line 3 lets them (10 mm).
std::optional<double> usual_floor_height(geometry::Point2 hall);

}  // namespace pulseline::simulation
