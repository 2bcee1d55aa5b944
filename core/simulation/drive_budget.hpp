#pragma once

#include "core/base/angle.hpp"

namespace pulseline::simulation {

/// The error budget of a simulated drive, written down: what separates its true motion from what
/// its wheels tell. Sigmas of constants are drawn once per vehicle from the seed. Together they end
/// a 20 m drive typically 3 to 8 mm and some hundredths of a degree off, as Tang 2020 measured
/// before correcting, and a move of some millimetres within a few tenths of one.
struct DriveBudget {
    // Geometry: what is left after calibration. Over 20 m the first gives 2 mm along.
    double diameter_common = 1e-4;      // share; temperature and load change all tyres alike
    double diameter_each = 1.2e-5;      // share; 20 m at 0.84 m between wheels: 0.02 deg
    double wheel_place = 3e-4;          // share of a wheel's place: scale of turns
    double steering_common_rad = 6e-5;  // all wheels askew: 1.2 mm across in 20 m
    double steering_each_rad = 3e-5;    // 20 m at 9.6 m between wheels: 0.004 deg, 0.6 mm across
    double play_m = 2e-4;               // lost motion of gear and tyre when the direction changes
    double scrub_m = 1e-4;              // wheels steered standing push the body by so much

    // Contact. Force over weight, divided by the stiffness, is the share lost.
    double creep_stiffness = 100;       // polyurethane on concrete: 2e-4 while 0.2 m/s2 accelerate
    double side_stiffness = 30;         // across, on a slope
    double roller_slip = 4e-4;          // share of a sideways motion on Mecanum rollers
    double roller_wander = 1.3;         // they wander across so many times as much as tyres do
    double grade = 1e-3;                // slope of the floor, each direction: within DIN 18202
    double wander_m_per_sqrt_m = 4e-4;  // random walk, along and across
    double wander_rad_per_sqrt_m = 8e-5;  // of the heading
    double wander_rad_per_sqrt_rad = 2e-4;
    double patch_every_m = 25;  // dust or oil below one wheel, at random on average so often
    double patch_m = 0.3;
    double patch_slip = 1e-3;  // share; 0.3 mm each

    // The chassis, when it stands.
    double settle_m = 8e-4;  // sag when it brakes from full speed
    double settle_rad = 8e-4;
    double fine_m = 5e-5;  // at least, in each stop
    double fine_rad = radians(0.003);

    // Steering.
    double aligned_rad = radians(0.2);  // wheels closer to their direction may roll
    // Supervision.
    double slip_limit = 0.07;  // share between rim and floor: one wheel of two losing 20 % shows 10
    double slip_time_s = 0.25;
    double slip_speed_mps = 0.05;     // slower says nothing
    double following_limit_m = 0.04;  // of a wheel; 0.01 is usual
    // Of the way of slip_time_s: a wheel that lags so far is blamed on its encoder, not the floor.
    double lag_share = 0.5;
    double steering_limit_rad = radians(8);  // of following: half a degree is usual
    double path_limit_m = 0.12;              // an order may begin 0.05 m from its first node
    double path_limit_rad = radians(4);
};

}  // namespace pulseline::simulation
