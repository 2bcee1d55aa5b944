#pragma once

#include <random>

#include "core/localisation/error_budget.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::simulation {

/// The camera as it truly hangs and images, where the vehicle's program knows only the calibrated
/// one: drawn once for a vehicle. `loaded`: it carries its load, under which tyres and frame give.
plant::Camera true_camera(plant::Camera calibrated, const localisation::CameraErrors& errors,
                          bool loaded, std::mt19937_64& random);

}  // namespace pulseline::simulation
