#pragma once

#include <vector>

#include "core/plant/vehicle_type.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// What is wrong with the feet on which a vehicle stands, by their own cells: footOverloaded {foot,
/// force_n, limit_n}, footLostContact {foot, force_n}. Of feet at rest, all of them down; while
/// they move, the machine looks itself. None: it has no such feet, or they hold as they should.
std::vector<vda5050::VehicleError> foot_faults(const plant::VehicleType& type,
                                               const std::vector<vda5050::ParkingFoot>& feet);

}  // namespace pulseline::onboard
