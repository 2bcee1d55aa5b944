#pragma once

#include <optional>
#include <utility>

#include "core/onboard/pose/light_watch.hpp"
#include "core/onboard/stop_sensing.hpp"
#include "server/agent/machine.hpp"

namespace pulseline::agent {

/// What a vehicle measures a stop by: the codes below its cameras or the light on its receivers,
/// whichever states the smaller sigma.
class StopSenses : public onboard::StopSensing {
public:
    /// `cameras` must outlive it, like what it uses.
    explicit StopSenses(Cameras& cameras) : cameras_(cameras) {}
    void use(const onboard::LightWatch& light) { light_ = &light; }

    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) override;
    /// The fix of the newest measurement, once.
    std::optional<localisation::PoseFix> take_fix() { return std::exchange(fix_, std::nullopt); }

private:
    Cameras& cameras_;
    const onboard::LightWatch* light_ = nullptr;
    std::optional<localisation::PoseFix> fix_;
};

}  // namespace pulseline::agent
