#pragma once

#include "api/vda5050/header.hpp"
#include "core/vda5050/messages.hpp"

/// Our own entries of state.information (infoType bracketLoad, wheel, camera, parkingFoot, load):
/// the values travel as infoReferences. Optional for a vehicle; other types are ignored.
namespace pulseline::vda5050 {

Json encode_information(const StateMessage& state);
void decode_information(json::ObjectReader& message, StateMessage& state);

}  // namespace pulseline::vda5050
