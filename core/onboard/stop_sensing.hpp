#pragma once

#include "core/base/result.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Port: what the cameras of a vehicle that stands or creeps make of the codes below it.
class StopSensing {
public:
    virtual ~StopSensing() = default;
    /// Pose of the body in the hall frame from the codes of `target` now in view. Reason codes:
    /// no_marker_in_view, and those of the localisation; of Errc::kUnavailable where it cannot look
    /// at all.
    virtual Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) = 0;
};

}  // namespace pulseline::onboard
