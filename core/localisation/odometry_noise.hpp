#pragma once

#include "core/localisation/error_budget.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::localisation {

/// How the odometry of a vehicle errs, one sigma. The defaults are of a machine that nobody has
/// looked after.
struct OdometryNoise {
    // Random walks: what a step adds does not depend on how the way is cut into steps.
    double forward_m_per_sqrt_m = 1e-3;
    double left_m_per_sqrt_m = 1e-3;
    double heading_rad_per_sqrt_m = 2e-4;
    double heading_rad_per_sqrt_rad = 1e-3;
    // Besides, of a way to the side, whose constants nobody learns.
    double sideways_m_per_sqrt_m = 2e-3;
    double sideways_rad_per_sqrt_m = 1e-4;
    // Constants of the machine, not known beforehand, which codes show (PoseFilter).
    double scale = 3e-4;           // share of the way
    double crab_rad = 2e-4;        // between the body's x axis and where it rolls to
    double bend_rad_per_m = 5e-5;  // it turns while its wheels say that it goes straight
    // A floor's slope pulls another way in another direction: parts of the constants that a turn
    // makes unknown again.
    double slope_scale = 2e-5;
    double slope_crab_rad = 6e-5;
    // What the chassis does when it comes to rest: always, and from full speed besides.
    double fine_m = 1e-4;
    double fine_rad = 1e-4;
    double settle_m = 1.6e-3;
    double settle_rad = 1.6e-3;
};

/// Of a vehicle of this type whose machine errs by `errors`: what each wheel's errors do to the
/// body (RollingWheels), and what the floor adds.
OdometryNoise odometry_noise(const DriveErrors& errors, const plant::VehicleType& type);

}  // namespace pulseline::localisation
