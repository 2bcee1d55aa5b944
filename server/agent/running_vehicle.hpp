#pragma once

#include "server/agent/vehicle.hpp"

namespace pulseline::agent {

/// The program of a vehicle with the machine that it drives.
class RunningVehicle {
public:
    virtual ~RunningVehicle() = default;
    virtual void step(double dt_s, Vehicle::Steady::time_point now) = 0;
    virtual Vehicle& program() = 0;
};

}  // namespace pulseline::agent
