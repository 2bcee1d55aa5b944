#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/fleet/vehicle_messages.hpp"
#include "core/simulation/drive.hpp"

namespace pulseline::agent {

/// What the rest of the machine reports: brackets and wheels.
class BodyStatus {
public:
    BodyStatus(const plant::Vehicle& vehicle, const simulation::Drive& motion, std::uint64_t seed);

    void step(double dt_s);
    void break_wheel(const std::string& name) { broken_wheel_ = name; }
    void write_state(fleet::StateMessage& state);

private:
    std::vector<kinematics::WheelMotion> wheel_motions() const;
    std::string faulty_wheel() const;

    const simulation::Drive& motion_;
    double load_kg_;
    std::mt19937_64 random_;
    std::vector<double> bracket_share_;  // of the load, two sensors each
    std::vector<fleet::WheelStatus> wheels_;
    std::vector<kinematics::WheelMotion> rolling_;
    std::string broken_wheel_;
};

}  // namespace pulseline::agent
