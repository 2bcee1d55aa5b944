#include "server/agent/body_status.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::agent {
namespace {

constexpr double kGravity_mps2 = 9.80665;
constexpr double kUneven = 0.03;  // how unevenly the load lies on the brackets
constexpr double kForceNoise = 0.002;
constexpr double kAmbient_c = 22;
constexpr double kHeat_c = 18;  // above ambient at full speed for long
constexpr double kHeatTime_s = 600;

}  // namespace

BodyStatus::BodyStatus(const plant::Vehicle& vehicle, const simulation::Drive& motion,
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

/// As the drive tells; one without a model of its wheels has those of its twist.
std::vector<kinematics::WheelMotion> BodyStatus::wheel_motions() const {
    auto told = motion_.wheels();
    if (!told.empty()) return told;
    const auto wheels = kinematics::wheels_of(motion_.type(), motion_.twist(), rolling_);
    return wheels ? *wheels : std::vector<kinematics::WheelMotion>(wheels_.size());
}

void BodyStatus::step(double dt_s) {
    const double full_mps = motion_.type().max_speed_mps * motion_.time_factor();
    rolling_ = wheel_motions();
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
        const double speed = std::abs(rolling_[i].speed_mps);
        wheels_[i].steering_rad = rolling_[i].angle_rad;
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
