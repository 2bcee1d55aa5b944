#pragma once

#include <memory>

#include "server/agent/picture_sources.hpp"
#include "server/agent/running_vehicle.hpp"
#include "server/agent/tcp_machine.hpp"
#include "server/agent/truth_log.hpp"

namespace pulseline::agent {

/// The program of a vehicle on a machine behind its controller. Nobody here knows where it truly
/// stands.
class TcpVehicle final : public RunningVehicle {
public:
    /// `vehicle` and `log`, where there is one, must outlive it; whether it is `loaded` its plant
    /// knows. Errors: those of TcpMachine::open and of open_sources for `cameras`; unknown_vehicle.
    static Result<std::unique_ptr<TcpVehicle>> open(const MachineAddress& address,
                                                    const plant::Plant& plant,
                                                    const plant::Vehicle& vehicle,
                                                    TcpMachine::Settings settings,
                                                    const std::vector<CameraSource>& cameras,
                                                    VehicleSettings known, BeliefLog* log);

    void step(double dt_s, Vehicle::Steady::time_point now) override;
    Vehicle& program() override { return *program_; }

private:
    TcpVehicle() = default;
    void write_belief(Vehicle::Steady::time_point now);

    plant::VehicleType type_;  // its cameras as they hang under its load
    std::unique_ptr<TcpMachine> machine_;
    std::unique_ptr<Vehicle> program_;
    BeliefLog* log_ = nullptr;
    BeliefLine told_;
    Vehicle::Steady::time_point told_at_{};
};

}  // namespace pulseline::agent
