#pragma once

#include "api/http/wire/common_json.hpp"
#include "api/http/wire/contexts.hpp"
#include "core/fleet/state/views.hpp"

namespace pulseline::api {

/// The plant gives names and loads, `images` the times of the newest camera pictures.
Json vehicle_json(const plant::Plant& plant, const CameraImages& images,
                  const fleet::VehicleView& vehicle);
Json fleet_json(const plant::Plant& plant, const fleet::FleetView& fleet);
Json station_state_json(const fleet::StationView& station);

}  // namespace pulseline::api
