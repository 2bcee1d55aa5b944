#pragma once

#include <cstddef>

#include "core/plant/plant.hpp"

namespace pulseline::fleet {

/// Number of a hall in the ids of tiles.
std::size_t hall_index(const plant::Plant& plant, const plant::HallId& hall);

}  // namespace pulseline::fleet
