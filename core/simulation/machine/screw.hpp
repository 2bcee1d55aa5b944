#pragma once

#include "core/plant/vehicle_type.hpp"
#include "core/simulation/machine/servo_axis.hpp"

namespace pulseline::simulation {

/// A screw with its servo motor that lifts some tonnes: for brackets and feet. `most_force_n`: half
/// of what the motor can push.
inline ServoParameters screw(double most_force_n, double speed_mps,
                             const plant::AxisControl& control) {
    constexpr double kCurrent_a = 20;
    constexpr double kInertia_kg = 5000;  // motor and screw, seen from the nut
    constexpr double kFriction = 0.05;    // of the greatest force
    ServoParameters p;
    p.coulomb_friction = kFriction * most_force_n;
    p.force_per_ampere = 2 * most_force_n / kCurrent_a;
    p.current_limit_a = kCurrent_a;
    p.rotor_inertia = kInertia_kg;
    p.viscous_friction = 1e4;
    p.tuned_inertia = kInertia_kg;
    p.position_gain_per_s = control.lift_gain_per_s;
    p.cycle_s = control.cycle_s;
    p.speed_limit = 1.3 * speed_mps;
    p.increment = 1e-7;
    return p;
}

}  // namespace pulseline::simulation
