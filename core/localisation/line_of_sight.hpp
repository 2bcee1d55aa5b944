#pragma once

#include "core/plant/plant.hpp"

namespace pulseline::localisation {

/// Whether nothing of the plant stands between two points of a hall: obstacles, and what its grid
/// has, are taken to reach up to the roof, since the plant does not say how high they are.
bool in_sight(const plant::Plant& plant, const plant::HallId& hall, geometry::Point2 from,
              geometry::Point2 to);

}  // namespace pulseline::localisation
