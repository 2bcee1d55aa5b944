#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/kinematics/wheels.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/onboard/motion/drive_limits.hpp"
#include "core/simulation/machine/servo_axis.hpp"

namespace pulseline::simulation {

/// The wheels of a vehicle with their servo axes: one rolls a driven wheel, one steers a steered
/// one (Tang 2020, section 2.1: two motors a drive wheel, one a wheel for steering). Wheels neither
/// driven nor steered follow. What the encoders tell and what the wheels truly do differ by the
/// budget's constants. All in the vehicle's own time, cycle by cycle of the
/// type's control.
class WheelSet {
public:
    /// Between a command and what the drives do with it.
    static constexpr int kDeadCycles = 2;

    /// REQUIRES: a driven wheel. `load_kg`: carried by the vehicle.
    WheelSet(const plant::VehicleType& type, double load_kg,
             const localisation::DriveErrors& errors, std::mt19937_64& random);

    /// One cycle towards `wanted`, one a wheel. `standing`: the brakes hold, steering only.
    /// `grade_force_n`: slope, on each wheel along its rolling direction.
    void cycle(std::span<const kinematics::WheelMotion> wanted, bool standing,
               std::span<const double> grade_force_n);
    /// The vehicle carries so much from now on. REQUIRES: it stands.
    void set_load(double load_kg);
    /// Brakes on: nothing moves and the loops forget.
    void brake();

    /// Where the wheels are being steered to, for kinematics::wheels_of.
    const std::vector<kinematics::WheelMotion>& present() const { return present_; }
    /// As the encoders tell of the last cycle; a wheel without motor rolls as commanded.
    const std::vector<kinematics::WheelMotion>& measured() const { return measured_; }
    /// As they truly rolled and stood, without slip on the floor.
    const std::vector<kinematics::WheelMotion>& rolled() const { return rolled_; }
    /// Change of a wheel's true speed in the last cycle.
    double accel_mps2(std::size_t wheel) const { return wheels_[wheel].accel_mps2; }

    /// Every steered wheel within `limit_rad` of what is wanted.
    bool aligned(std::span<const kinematics::WheelMotion> wanted, double limit_rad) const;
    /// Stands, and the position loops have come to rest.
    bool settled() const;
    /// The first wheel that is broken or does not follow its command.
    std::optional<std::string> fault() const;
    /// The first driven wheel that lags so far behind that its encoder, not the floor, is to blame.
    std::optional<std::string> lagging() const;
    /// Switches such a wheel's motor off until brake().
    void switch_off(const std::string& name);

    /// Too hot, its motors are off until it is not any more.
    void set_hot(std::size_t wheel, bool hot);

    // Faults from outside; false: there is no such wheel (or it has no motor to lose).
    bool break_wheel(const std::string& name);
    bool kill_encoder(const std::string& name);

private:
    struct Wheel {
        plant::Wheel plan;
        std::optional<ServoAxis> roll;
        std::optional<ServoAxis> steer;
        double roll_m = 0;  // commanded
        double wanted_mps = 0;
        double steer_rad = 0;  // commanded
        double diameter_scale = 1;
        double zero_rad = 0;
        double contact_m = 0;  // rim behind the play
        double faulty_mps = 0;
        double speed_mps = 0;  // true, of the rim's contact
        double accel_mps2 = 0;
        bool broken = false;
        bool blind = false;
        bool hot = false;
    };

    void steer(Wheel& wheel, double wanted_rad);
    double roll(Wheel& wheel, double wanted_mps, double grade_force_n);

    localisation::DriveErrors errors_;
    onboard::DriveLimits limits_;
    std::vector<Wheel> wheels_;
    std::vector<kinematics::WheelMotion> present_;
    std::vector<kinematics::WheelMotion> measured_;
    std::vector<kinematics::WheelMotion> rolled_;
    plant::VehicleType type_;
    double max_accel_mps2_;
    double steering_rate_radps_;
};

}  // namespace pulseline::simulation
