#include "core/simulation/machine/servo_axis.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::simulation {
namespace {

// The drive's filter of its measured velocity: counts of 1 ms alone would make the motor rattle.
constexpr double kVelocityFilter = 0.4;

}  // namespace

ServoAxis::ServoAxis(const ServoParameters& parameters, std::uint64_t seed)
    : parameters_(parameters),
      drive_steps_(static_cast<int>(std::lround(parameters.cycle_s / kDriveStep_s))),
      random_(seed),
      current_lag_(std::exp(-parameters.current_loop_radps * kDriveStep_s)),
      inertia_(parameters.rotor_inertia) {
    on_the_way_.assign(parameters.dead_cycles, {});
}

void ServoAxis::set_load(double inertia) { inertia_ = parameters_.rotor_inertia + inertia; }

double ServoAxis::read_encoder() {
    if (dead_encoder_) return measured_;
    // 2^-63: the signed draw becomes a number of [-1, 1).
    const double noise = static_cast<double>(static_cast<std::int64_t>(random_())) * 0x1p-63;
    const double counts = position_ / parameters_.increment + parameters_.noise_increments * noise;
    return parameters_.increment * std::round(counts);
}

void ServoAxis::cycle(double position, double velocity) {
    on_the_way_.push_back({position, velocity});
    const Command command = on_the_way_.front();
    on_the_way_.pop_front();
    commanded_ = command.position;
    const double wanted =
        std::clamp(parameters_.feedforward * command.velocity +
                       parameters_.position_gain_per_s * (command.position - measured_),
                   -parameters_.speed_limit, parameters_.speed_limit);
    for (int i = 0; i < drive_steps_; ++i) drive_step(wanted);
}

void ServoAxis::drive_step(double wanted_velocity) {
    constexpr double h = kDriveStep_s;
    const ServoParameters& p = parameters_;

    // Velocity PI; its integral stands still while the current is at its limit (anti-windup).
    const double error = wanted_velocity - measured_velocity_;
    const double gain = p.tuned_inertia * p.velocity_loop_radps;
    const double limit = p.force_per_ampere * p.current_limit_a;
    const double wanted_force = gain * error + integral_;
    // The overspeed limiter of the drive: at the limit nothing pushes on.
    const bool overspeed =
        std::abs(measured_velocity_) >= p.speed_limit && measured_velocity_ * wanted_force > 0;
    at_limit_ = std::abs(wanted_force) > limit;
    if (!(at_limit_ || overspeed) || error * wanted_force < 0) {
        integral_ += gain / p.velocity_integral_s * error * h;
    }
    const double wanted_a =
        overspeed ? 0 : std::clamp(wanted_force, -limit, limit) / p.force_per_ampere;
    current_a_ = wanted_a + (current_a_ - wanted_a) * current_lag_;

    const double driving = p.force_per_ampere * current_a_ + external_force_;
    const double free =
        (velocity_ + h * driving / inertia_) / (1 + h * p.viscous_friction / inertia_);
    const double stopping = h * p.coulomb_friction / inertia_;
    velocity_ = std::abs(free) <= stopping ? 0 : free - std::copysign(stopping, free);
    position_ += h * velocity_;

    const double read = read_encoder();
    measured_velocity_ += kVelocityFilter * ((read - measured_) / h - measured_velocity_);
    measured_ = read;
}

void ServoAxis::brake() {
    velocity_ = current_a_ = integral_ = measured_velocity_ = 0;
    at_limit_ = false;
    commanded_ = measured_;
    for (Command& command : on_the_way_) command = {measured_, 0};
}

void ServoAxis::preload(double force) {
    integral_ = force;
    current_a_ = force / parameters_.force_per_ampere;
}

void ServoAxis::home(double position) {
    position_ = measured_ = position;
    brake();
}

}  // namespace pulseline::simulation
