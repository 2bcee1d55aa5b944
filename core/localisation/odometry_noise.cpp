#include "core/localisation/odometry_noise.hpp"

#include <cmath>

#include "core/base/square.hpp"
#include "core/kinematics/rolling_wheels.hpp"

namespace pulseline::localisation {
namespace {

using kinematics::RollingWheels;
using kinematics::Twist;
using kinematics::WheelMotion;

// Sideways drives are short, and their constants are not learned: walks that come to the same after
// so long a way.
constexpr double kSideways_m = 10;
// As much turning in one direction as comes before codes are read again.
constexpr double kTurns_rad = kPi;
constexpr double kProbe = 1e-6;

/// Sums over the wheels of the squares of what one unit of an error of each does to a body that
/// moves at 1 m/s.
struct Effect {
    double forward2 = 0;
    double left2 = 0;
    double turn2 = 0;
};

struct Effects {
    Effect rim;    // a wheel that is larger than it should be
    Effect askew;  // one that points elsewhere
};

Effects effects_on(const plant::VehicleType& vehicle, const Twist& unit) {
    const RollingWheels rolling(vehicle);
    const auto motions = kinematics::wheels_of(vehicle, unit);
    if (!motions) return {};  // it cannot move so
    const Twist nominal = rolling.body_of(*motions).twist;
    const auto add = [&](Effect& effect, const std::vector<WheelMotion>& changed) {
        const Twist twist = rolling.body_of(changed).twist;
        effect.forward2 += square((twist.vx_mps - nominal.vx_mps) / kProbe);
        effect.left2 += square((twist.vy_mps - nominal.vy_mps) / kProbe);
        effect.turn2 += square((twist.turn_radps - nominal.turn_radps) / kProbe);
    };
    Effects effects;
    for (const std::size_t i : rolling.index) {
        auto changed = *motions;
        changed[i].speed_mps *= 1 + kProbe;
        add(effects.rim, changed);
        changed = *motions;
        changed[i].angle_rad += kProbe;
        add(effects.askew, changed);
    }
    return effects;
}

}  // namespace

OdometryNoise odometry_noise(const DriveErrors& errors, const plant::VehicleType& type) {
    const Effects ahead = effects_on(type, {1, 0, 0});
    const Effects aside = effects_on(type, {0, 1, 0});
    const auto constants2 = [&](double Effect::*part, const Effects& of) {
        return square(errors.diameter_each) * of.rim.*part +
               square(errors.steering_each_rad) * of.askew.*part;
    };
    // A patch below one wheel, whichever, now and then.
    const auto wheels = static_cast<double>(kinematics::RollingWheels(type).index.size());
    const double patch2_per_m =
        wheels > 0 && errors.patch_every_m > 0
            ? square(errors.patch_slip * errors.patch_m) / errors.patch_every_m / wheels
            : 0;
    const bool rollers = type.kinematics == plant::Kinematics::kMecanum;
    const double wander2 = square(errors.wander_m_per_sqrt_m);
    // Slope: what holds the vehicle on it is lost along, and tyres give way across.
    const double slope_along = errors.grade / errors.creep_stiffness;
    const double slope_across = errors.grade / errors.side_stiffness;

    OdometryNoise noise;
    noise.forward_m_per_sqrt_m = std::sqrt(wander2 + patch2_per_m * ahead.rim.forward2);
    noise.left_m_per_sqrt_m = std::sqrt((rollers ? square(errors.roller_wander) : 1) * wander2 +
                                        patch2_per_m * ahead.rim.left2);
    noise.heading_rad_per_sqrt_m =
        std::sqrt(square(errors.wander_rad_per_sqrt_m) + patch2_per_m * ahead.rim.turn2);
    noise.heading_rad_per_sqrt_rad =
        std::hypot(errors.wander_rad_per_sqrt_rad, errors.wheel_place * std::sqrt(kTurns_rad));
    // Of the scale of a way to the side the slope is the least.
    const double sideways2 = square(errors.diameter_common) + constants2(&Effect::left2, aside) +
                             (rollers ? square(errors.roller_slip) : 0);
    noise.sideways_m_per_sqrt_m = std::sqrt(kSideways_m * sideways2);
    noise.sideways_rad_per_sqrt_m = std::sqrt(kSideways_m * constants2(&Effect::turn2, aside));
    noise.slope_scale = slope_along;
    noise.slope_crab_rad = slope_across;
    noise.scale = std::sqrt(square(errors.diameter_common) + constants2(&Effect::forward2, ahead) +
                            square(slope_along));
    noise.crab_rad = std::sqrt(square(errors.steering_common_rad) +
                               constants2(&Effect::left2, ahead) + square(slope_across));
    noise.bend_rad_per_m = std::sqrt(constants2(&Effect::turn2, ahead));
    noise.fine_m = std::hypot(errors.fine_m, errors.play_m / 2, errors.scrub_m);
    noise.fine_rad = errors.fine_rad;
    noise.settle_m = errors.settle_m;
    noise.settle_rad = errors.settle_rad;
    return noise;
}

}  // namespace pulseline::localisation
