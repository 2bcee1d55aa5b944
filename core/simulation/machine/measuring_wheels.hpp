#pragma once

#include <optional>
#include <random>
#include <span>
#include <vector>

#include "core/kinematics/wheels.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/onboard/motion/drive_limits.hpp"

namespace pulseline::simulation {

/// Free-rolling wheels beside the driven ones (plant::SlipSensor): they roll with the floor, with a
/// scale of their own and noise in each look, and so show what the driven ones lose.
class MeasuringWheels {
public:
    static constexpr double kLook_s = 0.02;

    /// Shows nothing when the type has none.
    MeasuringWheels(const plant::VehicleType& type, const localisation::SlipSensorErrors& errors,
                    std::mt19937_64& random);

    /// The largest share, between the speed of a wheel in `index` at its rim and that of the floor
    /// below it, smoothed over some looks. `true_twist`: what the floor does to the measuring
    /// wheels. nullopt: no sensor, or too slow to say. Call once a cycle of `h_s`.
    std::optional<double> slip_share(std::span<const kinematics::WheelMotion> measured,
                                     std::span<const std::size_t> index,
                                     const kinematics::Twist& true_twist, double h_s,
                                     std::mt19937_64& random);
    /// The vehicle stands.
    void rest();

private:
    struct Wheel {
        double scale = 1;
        double lost_mps = 0;  // smoothed
        double pace_mps = 0;
    };

    const plant::VehicleType type_;
    std::vector<Wheel> wheels_;
    onboard::DriveLimits limits_;
    double since_look_s_ = kLook_s;
    std::normal_distribution<double> normal_;
};

}  // namespace pulseline::simulation
