#include "core/simulation/machine/measuring_wheels.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/rolling_wheels.hpp"

namespace pulseline::simulation {
namespace {

// Five looks: their noise is a fifth of a look's or so, and a slip is seen within 0.1 s.
constexpr double kSmooth = 0.2;

}  // namespace

MeasuringWheels::MeasuringWheels(const plant::VehicleType& type,
                                 const localisation::SlipSensorErrors& errors,
                                 std::mt19937_64& random)
    : type_(type), wheels_(type.slip_sensor ? type.wheels.size() : 0) {
    for (Wheel& wheel : wheels_) wheel.scale = 1 + errors.scale * normal_(random);
}

std::optional<double> MeasuringWheels::slip_share(std::span<const kinematics::WheelMotion> measured,
                                                  std::span<const std::size_t> index,
                                                  const kinematics::Twist& true_twist, double h_s,
                                                  std::mt19937_64& random) {
    if (wheels_.empty()) return std::nullopt;
    since_look_s_ += h_s;
    if (since_look_s_ >= kLook_s) {
        since_look_s_ = 0;
        for (const std::size_t i : index) {
            Wheel& wheel = wheels_[i];
            const double rim = measured[i].speed_mps;
            const double floor = kinematics::rolling_speed(type_, type_.wheels[i],
                                                           measured[i].angle_rad, true_twist);
            const double shown =
                wheel.scale * floor + type_.slip_sensor->noise_mps * normal_(random);
            wheel.lost_mps += kSmooth * (rim - shown - wheel.lost_mps);
            wheel.pace_mps += kSmooth * (std::max(std::abs(rim), std::abs(shown)) - wheel.pace_mps);
        }
    }
    std::optional<double> most;
    for (const std::size_t i : index) {
        const Wheel& wheel = wheels_[i];
        if (wheel.pace_mps < limits_.slip_speed_mps) continue;
        most = std::max(most.value_or(0), std::abs(wheel.lost_mps) / wheel.pace_mps);
    }
    return most;
}

void MeasuringWheels::rest() {
    for (Wheel& wheel : wheels_) wheel.lost_mps = wheel.pace_mps = 0;
    since_look_s_ = kLook_s;
}

}  // namespace pulseline::simulation
