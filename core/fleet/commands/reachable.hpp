#pragma once

#include <string>

#include "core/base/result.hpp"
#include "core/fleet/state/fleet_state.hpp"

/// Whether a vehicle that a person names can be told anything.
namespace pulseline::fleet {

/// unknown_vehicle {vehicle}
tl::unexpected<Error> no_such_vehicle(const plant::VehicleId& id);
/// Connected is not enough: only its first report says where it stands and what it does. Errors:
/// vehicle_silent, vehicle_not_reported; `wanted`: "Its position can be set", when it is heard.
Status is_heard(const LiveVehicle& live, const std::string& field, const std::string& wanted);

}  // namespace pulseline::fleet
