#pragma once

#include <string>
#include <vector>

#include "core/onboard/drive.hpp"
#include "core/simulation/machine/drive_heat.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::agent {

// Faults of a wheel's drive, as its status names them.
inline constexpr const char* kDriveFault = "drive_fault";
inline constexpr const char* kTooHot = "servo_overtemperature";

/// The faults of the state's wheels as errors of the vehicle.
void write_wheel_faults(const plant::VehicleType& type, vda5050::StateMessage& state);
/// Why a drive has stopped of itself, as an error of the vehicle; but a fault that a wheel of the
/// state tells by itself.
void write_stop(const onboard::Drive& drive, vda5050::StateMessage& state);

/// What the rest of the machine reports: its wheels, and why its drive has stopped.
class BodyStatus {
public:
    explicit BodyStatus(const onboard::Drive& motion);

    void step(double dt_s);
    void break_wheel(const std::string& name) { broken_wheel_ = name; }
    /// The wheel runs hot when it turns. False: there is no such wheel.
    bool seize_bearing(const std::string& name) { return heat_.seize_bearing(name); }
    const simulation::DriveHeat& heat() const { return heat_; }
    void write_state(vda5050::StateMessage& state) const;

private:
    std::vector<kinematics::WheelMotion> wheel_motions() const;
    std::string faulty_wheel() const;

    const onboard::Drive& motion_;
    std::vector<vda5050::WheelStatus> wheels_;
    std::vector<kinematics::WheelMotion> rolling_;
    std::string broken_wheel_;
    simulation::DriveHeat heat_;
};

}  // namespace pulseline::agent
