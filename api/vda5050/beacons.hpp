#pragma once

#include <vector>

#include "api/json/object_reader.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::vda5050 {

using json::Json;

/// The parameter `transmitters` of setTransmitters.
Json transmitters_json(const std::vector<plant::Transmitter>& transmitters);
std::vector<plant::Transmitter> read_transmitters(json::ObjectReader& in);
/// The parameter `reflectors` of setReflectors.
Json reflectors_json(const std::vector<plant::Reflector>& reflectors);
std::vector<plant::Reflector> read_reflectors(json::ObjectReader& in);

}  // namespace pulseline::vda5050
