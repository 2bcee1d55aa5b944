#pragma once

#include "api/http/common_json.hpp"
#include "core/fleet/views.hpp"

namespace pulseline::api {

Json plant_json(const plant::Plant& plant);
Json station_state_json(const fleet::StationView& station);

}  // namespace pulseline::api
