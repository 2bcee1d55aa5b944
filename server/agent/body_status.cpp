#include "server/agent/body_status.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::agent {
namespace {

using Kind = kinematics::Segment::Kind;

constexpr double kGravity_mps2 = 9.80665;
constexpr double kUneven = 0.03;  // how unevenly the load lies on the brackets
constexpr double kForceNoise = 0.002;
constexpr double kAmbient_c = 22;
constexpr double kHeat_c = 18;  // above ambient at full speed for long
constexpr double kHeatTime_s = 600;

struct Twist {
    double vx_mps = 0;
    double vy_mps = 0;
    double turn_radps = 0;
};

Twist twist_of(const simulation::VehicleMotion& motion) {
    Twist twist;
    const auto* segment = motion.current();
    if (segment == nullptr) return twist;
    twist.turn_radps = motion.turn_rate_radps();
    const double speed = std::abs(motion.velocity_mps());
    if (segment->kind == Kind::kStraight) {
        twist.vx_mps = speed * std::cos(segment->direction_rad);
        twist.vy_mps = speed * std::sin(segment->direction_rad);
    } else if (segment->kind == Kind::kArc) {
        twist.vx_mps = motion.velocity_mps();
    }
    return twist;
}

/// Wheels roll both ways: a steering angle within a quarter turn.
double folded(double angle_rad) {
    if (angle_rad > kPi / 2 + 1e-9) return angle_rad - kPi;
    if (angle_rad < -kPi / 2 - 1e-9) return angle_rad + kPi;
    return angle_rad;
}

}  // namespace

BodyStatus::BodyStatus(const plant::Vehicle& vehicle, const simulation::VehicleMotion& motion,
                       std::uint64_t seed)
    : motion_(motion), load_kg_(vehicle.load_kg), random_(seed) {
    std::uniform_real_distribution<double> uneven(1 - kUneven, 1 + kUneven);
    double sum = 0;
    for (std::size_t i = 0; i < 2 * motion.type().brackets.size(); ++i) {
        bracket_share_.push_back(uneven(random_));
        sum += bracket_share_.back();
    }
    for (double& share : bracket_share_) share /= sum;
    for (const auto& wheel : motion.type().wheels) {
        wheels_.push_back({wheel.name, 0, 0, kAmbient_c, ""});
    }
}

void BodyStatus::step(double dt_s) {
    const Twist twist = twist_of(motion_);
    const auto& wheels = motion_.type().wheels;
    const double full_mps = motion_.type().max_speed_mps * motion_.time_factor();
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        const double vx = twist.vx_mps - twist.turn_radps * wheels[i].position.y_m;
        const double vy = twist.vy_mps + twist.turn_radps * wheels[i].position.x_m;
        const double speed = std::hypot(vx, vy);
        if (wheels[i].steered && speed > 1e-6) wheels_[i].steering_rad = folded(std::atan2(vy, vx));
        wheels_[i].speed_mps = speed;
        const double target_c = kAmbient_c + kHeat_c * std::min(1.0, speed / full_mps);
        const double share = std::min(1.0, dt_s * motion_.time_factor() / kHeatTime_s);
        wheels_[i].temperature_c += share * (target_c - wheels_[i].temperature_c);
        wheels_[i].fault = wheels_[i].name == broken_wheel_ ? "steering_drive_fault" : "";
    }
}

void BodyStatus::write_state(fleet::StateMessage& state) {
    std::normal_distribution<double> noise(1, kForceNoise);
    const auto& brackets = motion_.type().brackets;
    state.brackets.clear();
    for (std::size_t i = 0; i < brackets.size(); ++i) {
        const double weight_n = load_kg_ * kGravity_mps2;
        state.brackets.push_back({brackets[i].name,
                                  weight_n * bracket_share_[2 * i] * noise(random_),
                                  weight_n * bracket_share_[2 * i + 1] * noise(random_)});
    }
    state.wheels = wheels_;
    state.load_kg = load_kg_;
    if (!broken_wheel_.empty()) {
        state.errors.push_back({"wheelFault",
                                false,
                                "the steering drive of wheel " + broken_wheel_ + " has a fault",
                                {{"wheel", broken_wheel_}}});
    }
}

}  // namespace pulseline::agent
