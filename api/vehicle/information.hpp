#pragma once

#include "api/vehicle/header.hpp"
#include "core/fleet/state/vehicle_messages.hpp"

/// Our own entries of state.information (infoType bracketLoad, wheel, camera, parkingFoot, load):
/// the values travel as infoReferences. Optional for a vehicle; other types are ignored.
namespace pulseline::vda5050 {

Json encode_information(const fleet::StateMessage& state);
void decode_information(json::ObjectReader& message, fleet::StateMessage& state);

}  // namespace pulseline::vda5050
