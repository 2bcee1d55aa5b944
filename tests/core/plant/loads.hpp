#pragma once

#include <string>
#include <vector>

#include "core/plant/plant.hpp"

/// Loads for plants that tests make themselves.
namespace pulseline::plant::builders {

/// One near each corner of a small vehicle.
inline std::vector<Bracket> four_brackets() {
    return {{"front left", {1, 0.4}},
            {"front right", {1, -0.4}},
            {"back left", {-1, 0.4}},
            {"back right", {-1, -0.4}}};
}

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
