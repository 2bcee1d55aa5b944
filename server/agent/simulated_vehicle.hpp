#pragma once

#include <memory>
#include <string>

#include "server/agent/running_vehicle.hpp"
#include "server/agent/simulated_machine.hpp"
#include "server/agent/truth_log.hpp"

namespace pulseline::agent {

/// The program of a vehicle on a simulated machine, and the truth of both for those who judge.
class SimulatedVehicle final : public RunningVehicle {
public:
    struct Program {
        int vehicles = 1;          // in this process
        std::string learned = {};  // folder for what it learns; empty: forgotten at the end
        std::shared_ptr<const mapping::MatchedMap> map = {};  // of its hall; none: it has none
    };

    /// `world` and `truth` must outlive it.
    SimulatedVehicle(const simulation::World& world, const plant::Vehicle& vehicle,
                     const geometry::Pose2& true_pose, SimulationSettings settings, Program program,
                     TruthLog* truth);
    // The program knows where its machine is.
    SimulatedVehicle(const SimulatedVehicle&) = delete;
    SimulatedVehicle& operator=(const SimulatedVehicle&) = delete;

    void step(double dt_s, Vehicle::Steady::time_point now) override;
    Vehicle& program() override { return program_; }
    SimulatedMachine& machine() { return machine_; }

private:
    void write_truth(Vehicle::Steady::time_point now);

    const plant::VehicleType type_;  // its cameras as they hang under its load
    SimulatedMachine machine_;
    Vehicle program_;
    TruthLog* truth_;
    Vehicle::Steady::time_point last_truth_{};
    TruthLine last_truth_line_;
};

}  // namespace pulseline::agent
