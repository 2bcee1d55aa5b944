#pragma once

#include <string>
#include <vector>

#include "core/localisation/igps_light.hpp"

namespace pulseline::onboard {

/// What one receiver saw of the newest whole turn of each transmitter. Times are against now, by
/// the receivers' clock: all of them lie in the past.
struct ReceiverPulses {
    std::string receiver;
    std::vector<localisation::LightPulses> turns;
};

/// Port: the receivers of iGPS on a vehicle.
class Receivers {
public:
    virtual ~Receivers() = default;
    /// Time passes by `own_s`, of the vehicle's own time. What is new since the last call; empty:
    /// nothing.
    virtual std::vector<ReceiverPulses> take_pulses(double own_s) = 0;
};

}  // namespace pulseline::onboard
