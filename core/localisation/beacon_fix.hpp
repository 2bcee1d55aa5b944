#pragma once

#include <string>
#include <vector>

#include "core/localisation/dual_camera.hpp"

namespace pulseline::localisation {

/// Why a beacon, or what sees them, was left out of a pose.
struct LeftOut {
    std::string name;
    std::string code;  // as who left it out says
};

/// A pose by beacons, things in the hall that a vehicle knows from afar: the light of iGPS,
/// reflectors.
struct BeaconFix {
    PoseFix fix;  // payloads: the beacons it rests on
    /// The part of the covariance that the next fix has as well: of where the beacons stand and how
    /// what sees them is mounted. Whoever averages fixes does not get below it.
    CovarianceRows lasting{};
    std::vector<LeftOut> left_out;
};

}  // namespace pulseline::localisation
