#include "core/simulation/machine/wheel_set.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/gravity.hpp"

namespace pulseline::simulation {
namespace {

using kinematics::WheelMotion;

constexpr double kMotorCurrent_a = 60;
constexpr double kLightest_kg = 50;          // a type without a mass is a small vehicle
constexpr double kRollingResistance = 0.01;  // of the weight, with the gear
constexpr double kForceReserve = 2;          // motors are chosen for twice the full acceleration
constexpr double kRotorShare = 0.1;          // of the moved mass, seen through the gear
constexpr double kCountsPerRim = 30.0 * (1 << 17);  // gear x 17 bit
constexpr double kScrubArm_m = 0.01;                // friction x lever of a tyre turned on the spot
constexpr double kSteeringInertia = 20;             // kg m2, motor through its gear
constexpr double kSteeringCount_rad = 1e-5;
constexpr double kSettled_mps = 5e-4;
constexpr double kSettled_m = 1e-4;
constexpr double kBrakeShare = 2;  // a faulty wheel's brake against the usual deceleration

/// Parameters for the share of vehicle and load that each driven wheel moves.
ServoParameters rolling(const plant::VehicleType& type, const plant::Wheel& wheel, double load_kg,
                        double driven) {
    const double empty_kg = std::max(kLightest_kg, type.mass_kg) / driven;
    const double full_kg = empty_kg + type.max_load_kg / driven;
    ServoParameters p;
    p.coulomb_friction = kRollingResistance * kGravity_mps2 * (empty_kg + load_kg / driven);
    const double limit_n = kForceReserve * full_kg * type.max_accel_mps2 +
                           kRollingResistance * kGravity_mps2 * full_kg;
    p.force_per_ampere = limit_n / kMotorCurrent_a;
    p.current_limit_a = kMotorCurrent_a;
    p.rotor_inertia = kRotorShare * empty_kg;
    p.viscous_friction = 0.1 * p.coulomb_friction;
    p.tuned_inertia = p.rotor_inertia + (empty_kg + full_kg) / 2;
    p.speed_limit = 1.15 * type.max_speed_mps;
    p.position_gain_per_s = type.control.drive_gain_per_s;
    p.cycle_s = type.control.cycle_s;
    p.dead_cycles = WheelSet::kDeadCycles;
    p.increment = kPi * wheel.diameter_m / kCountsPerRim;
    return p;
}

ServoParameters steering(const plant::VehicleType& type, double load_kg) {
    const double weight_n = kGravity_mps2 * (std::max(kLightest_kg, type.mass_kg) + load_kg) /
                            static_cast<double>(type.wheels.size());
    ServoParameters p;
    p.coulomb_friction = kScrubArm_m * weight_n;
    p.force_per_ampere = (3 * p.coulomb_friction + 1000) / kMotorCurrent_a;
    p.current_limit_a = kMotorCurrent_a;
    p.rotor_inertia = kSteeringInertia;
    p.viscous_friction = 20;
    p.tuned_inertia = kSteeringInertia;
    p.position_gain_per_s = type.control.steering_gain_per_s;
    p.cycle_s = type.control.cycle_s;
    p.speed_limit = 1.5 * type.max_steering_rate_radps;
    p.dead_cycles = WheelSet::kDeadCycles;
    p.increment = kSteeringCount_rad;
    return p;
}

double driven_wheels(const plant::VehicleType& type) {
    return static_cast<double>(std::ranges::count_if(type.wheels, &plant::Wheel::driven));
}

}  // namespace

WheelSet::WheelSet(const plant::VehicleType& type, double load_kg,
                   const localisation::DriveErrors& errors, std::mt19937_64& random)
    : errors_(errors),
      type_(type),
      max_accel_mps2_(type.max_accel_mps2),
      steering_rate_radps_(type.max_steering_rate_radps) {
    const double driven = driven_wheels(type);
    assert(driven > 0);
    std::normal_distribution<double> normal;
    const double diameter = errors.diameter_common * normal(random);
    const double askew_rad = errors.steering_common_rad * normal(random);
    for (const auto& plan : type.wheels) {
        Wheel wheel;
        wheel.plan = plan;
        wheel.diameter_scale = 1 + diameter + errors.diameter_each * normal(random);
        // Fixed wheels are askew, too; Mecanum ones are what their rollers make of it.
        wheel.zero_rad = askew_rad + errors.steering_each_rad * normal(random);
        if (plan.driven) {
            wheel.roll.emplace(rolling(type, plan, load_kg, driven), random());
            wheel.roll->set_load((std::max(kLightest_kg, type.mass_kg) + load_kg) / driven);
        }
        if (plan.steered) {
            wheel.steer.emplace(steering(type, load_kg), random());
        }
        wheels_.push_back(std::move(wheel));
    }
    present_.resize(wheels_.size());
    measured_.resize(wheels_.size());
    rolled_.resize(wheels_.size());
    brake();
}

void WheelSet::set_load(double load_kg) {
    const double driven = driven_wheels(type_);
    for (Wheel& wheel : wheels_) {
        if (wheel.roll) {
            wheel.roll->set_load((std::max(kLightest_kg, type_.mass_kg) + load_kg) / driven);
            wheel.roll->set_friction(rolling(type_, wheel.plan, load_kg, driven).coulomb_friction);
        }
        if (wheel.steer) wheel.steer->set_friction(steering(type_, load_kg).coulomb_friction);
    }
}

void WheelSet::cycle(std::span<const WheelMotion> wanted, bool standing,
                     std::span<const double> grade_force_n) {
    assert(wanted.size() == wheels_.size() && grade_force_n.size() == wheels_.size());
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        Wheel& wheel = wheels_[i];
        steer(wheel, wanted[i].angle_rad);
        present_[i].angle_rad = wheel.steer_rad;
        measured_[i].angle_rad = wheel.steer ? wheel.steer->measured_position() : 0;
        rolled_[i].angle_rad = (wheel.steer ? wheel.steer->position() : 0) + wheel.zero_rad;
        if (standing) {
            measured_[i].speed_mps = rolled_[i].speed_mps = wheel.accel_mps2 = 0;
            continue;
        }
        // A wheel not yet where it should point pushes only with what points there.
        const double speed =
            wanted[i].speed_mps * std::cos(wanted[i].angle_rad - measured_[i].angle_rad);
        measured_[i].speed_mps = roll(wheel, speed, grade_force_n[i]);
        rolled_[i].speed_mps = wheel.speed_mps;
    }
}

void WheelSet::steer(Wheel& wheel, double wanted_rad) {
    if (!wheel.steer) return;
    if (wheel.broken || wheel.hot) return;  // its motor is off, the gear blocks itself
    const double most = steering_rate_radps_ * type_.control.cycle_s;
    const double step = std::clamp(wanted_rad - wheel.steer_rad, -most, most);
    wheel.steer_rad += step;
    wheel.steer->cycle(wheel.steer_rad, step / type_.control.cycle_s);
}

/// The speed that the encoder tells.
double WheelSet::roll(Wheel& wheel, double wanted_mps, double grade_force_n) {
    const double h = type_.control.cycle_s;
    const double before_mps = wheel.speed_mps;
    wheel.wanted_mps = wanted_mps;
    double measured_mps = wanted_mps;
    double rim_mps = wanted_mps;
    if (wheel.roll && (wheel.broken || wheel.blind || wheel.hot)) {
        // Its motor is off, its brake takes it along with the others.
        const double most = kBrakeShare * max_accel_mps2_ * h;
        wheel.faulty_mps += std::clamp(wanted_mps - wheel.faulty_mps, -most, most);
        rim_mps = measured_mps = wheel.faulty_mps;
    } else if (wheel.roll) {
        wheel.roll_m += wanted_mps * h;
        const double told_m = wheel.roll->measured_position();
        const double contact_m = wheel.contact_m;
        wheel.roll->set_external_force(grade_force_n);
        wheel.roll->cycle(wheel.roll_m, wanted_mps);
        const double half_m = errors_.play_m / 2;
        wheel.contact_m = std::clamp(wheel.contact_m, wheel.roll->position() - half_m,
                                     wheel.roll->position() + half_m);
        rim_mps = (wheel.contact_m - contact_m) / h;
        measured_mps = (wheel.roll->measured_position() - told_m) / h;
        wheel.faulty_mps = wheel.roll->velocity();
        wheel.blind = std::abs(wheel.roll->following_error()) > limits_.following_m;
    }
    wheel.speed_mps = rim_mps * wheel.diameter_scale;
    wheel.accel_mps2 = (wheel.speed_mps - before_mps) / h;
    return measured_mps;
}

void WheelSet::brake() {
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        Wheel& wheel = wheels_[i];
        if (wheel.roll) {
            wheel.roll->brake();
            wheel.roll_m = wheel.roll->measured_position();
        }
        wheel.speed_mps = wheel.accel_mps2 = wheel.faulty_mps = 0;
        wheel.blind = false;
        measured_[i].speed_mps = rolled_[i].speed_mps = 0;
    }
}

bool WheelSet::aligned(std::span<const WheelMotion> wanted, double limit_rad) const {
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        const Wheel& wheel = wheels_[i];
        if (!wheel.steer || wheel.broken || wheel.hot) continue;
        if (std::abs(wheel.steer->measured_position() - wanted[i].angle_rad) > limit_rad) {
            return false;
        }
    }
    return true;
}

bool WheelSet::settled() const {
    return std::all_of(wheels_.begin(), wheels_.end(), [](const Wheel& wheel) {
        if (!wheel.roll || wheel.broken || wheel.blind || wheel.hot)
            return std::abs(wheel.faulty_mps) == 0;
        return std::abs(wheel.roll->velocity()) < kSettled_mps &&
               std::abs(wheel.roll->following_error()) < kSettled_m;
    });
}

std::optional<std::string> WheelSet::fault() const {
    for (const Wheel& wheel : wheels_) {
        const bool astray =
            wheel.steer && std::abs(wheel.steer->following_error()) > limits_.steering_rad;
        if (wheel.broken || wheel.blind || wheel.hot || astray) return wheel.plan.name;
    }
    return std::nullopt;
}

std::optional<std::string> WheelSet::lagging() const {
    for (const Wheel& wheel : wheels_) {
        if (!wheel.roll) continue;
        const double missed_m = std::abs(wheel.wanted_mps) * limits_.slip_time_s;
        const double behind_m = std::abs(wheel.roll->following_error());
        if (behind_m > limits_.lag_share * missed_m) return wheel.plan.name;
    }
    return std::nullopt;
}

void WheelSet::switch_off(const std::string& name) {
    for (Wheel& wheel : wheels_) wheel.blind |= wheel.plan.name == name;
}

void WheelSet::set_hot(std::size_t wheel, bool hot) { wheels_[wheel].hot = hot; }

bool WheelSet::break_wheel(const std::string& name) {
    for (Wheel& wheel : wheels_) {
        if (wheel.plan.name != name) continue;
        wheel.broken = true;
        return true;
    }
    return false;
}

bool WheelSet::kill_encoder(const std::string& name) {
    for (Wheel& wheel : wheels_) {
        if (wheel.plan.name != name || !wheel.roll) continue;
        wheel.roll->set_dead_encoder(true);
        return true;
    }
    return false;
}

}  // namespace pulseline::simulation
