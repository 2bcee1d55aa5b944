#pragma once

#include "core/plant/plant.hpp"

namespace pulseline::plant {

/// Whether vehicles of the type drive where no lane leads: straight legs that are planned over free
/// floor, and manoeuvres between them.
bool drives_over_free_floor(const VehicleType& type);

}  // namespace pulseline::plant
