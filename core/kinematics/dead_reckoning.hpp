#pragma once

#include <span>

#include "core/kinematics/motion.hpp"

namespace pulseline::kinematics {

/// What makes a vehicle end beside where its wheels say, one sigma each. The first three are
/// constants of a vehicle, so that their effect grows with the way and may cancel on it; the others
/// are chance, growing with its root.
struct DeadReckoningNoise {
    double distance_scale = 1.5e-4;
    double turn_scale = 3e-4;
    double steering_bias_rad = 6e-5;  // of the direction driven
    double slip_m_per_sqrt_m = 3e-4;  // along and across
    double sideways_times = 1;  // how many times as much slip and scale on a way straight sideways
    double heading_rad_per_sqrt_m = 9e-5;
    double heading_rad_per_sqrt_rad = 2e-4;
    double stop_m = 1e-3;  // sag of the body when it stops
    double stop_rad = 1.1e-3;
};

/// Of a usual vehicle of the family, until its own arrivals tell (learned_deviation): what Tang
/// 2020 measured before correcting (3 to 8 mm and some hundredths of a degree after 20 m) on
/// steered wheels; two fixed wheels measure turns worse, and rollers slip more, most of all
/// sideways (Wang).
DeadReckoningNoise usual_noise(plant::Kinematics kinematics);

/// Root mean square of the deviation from the pose aimed at, when the vehicle has driven on
/// odometry alone and nothing is adjusted yet.
struct ExpectedDeviation {
    double position_m = 0;
    double heading_rad = 0;
};

ExpectedDeviation expected_deviation(std::span<const Segment> segments,
                                     const DeadReckoningNoise& noise);

/// How far a drive ended from where it was to end, and what expected_deviation() with usual_noise()
/// had said of its way.
struct ArrivalMiss {
    double position_m = 0;
    double heading_rad = 0;
    ExpectedDeviation usual;  // not 0
};

/// What to expect of one vehicle after a way of which `usual` is expected: that, times the root
/// mean square by which its own arrivals (newest ones, of the same motion mode) exceeded or fell
/// short of what was usual. Without any it is `usual`; the family counts like two arrivals, and one
/// arrival no more than ten times the usual, so that neither one good stop nor one push says all.
ExpectedDeviation learned_deviation(const ExpectedDeviation& usual,
                                    std::span<const ArrivalMiss> arrivals);

}  // namespace pulseline::kinematics
