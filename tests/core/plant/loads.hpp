#pragma once

#include <string>

#include "core/plant/plant.hpp"

/// Loads for plants that tests make themselves.
namespace pulseline::plant::builders {

/// The vehicle carries such a thing from the beginning, and may.
inline void put_on(Plant& plant, std::size_t vehicle, const std::string& name, double mass_kg = 0) {
    Load load;
    load.id = LoadId(name);
    load.name = name;
    load.mass_kg = mass_kg;
    load.vehicle = plant.vehicles[vehicle].id;
    load.vehicle_types = {plant.vehicles[vehicle].type};
    plant.loads.push_back(std::move(load));
}

}  // namespace pulseline::plant::builders
