#pragma once

#include "core/base/angle.hpp"

namespace pulseline::onboard {

/// When the supervision of a drive stops it, and what its wheels must be before they may roll.
struct DriveLimits {
    double aligned_rad = radians(0.2);  // wheels closer to their direction may roll
    double slip = 0.07;  // share between rim and floor: one wheel of two losing 20 % shows 10
    double slip_time_s = 0.25;
    double slip_speed_mps = 0.05;  // slower says nothing
    double following_m = 0.04;     // of a wheel; 0.01 is usual
    double lag_share = 0.5;        // of the way of slip_time_s: a wheel that lags so far is blamed
                                   // on its encoder, not the floor
    double steering_rad = radians(8);  // of following: half a degree is usual
    double path_m = 0.12;              // an order may begin 0.05 m from its first node
    double path_rad = radians(4);
};

}  // namespace pulseline::onboard
