#pragma once

#include <span>
#include <vector>

#include "core/localisation/dual_camera.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// A code read in a picture that was taken while the vehicle drove.
struct WayReading {
    vda5050::SurveyedMarker marker;      // the expected one that lies there
    localisation::CodeObservation seen;  // of another payload: the codes were exchanged
    double age_s = 0;                    // since the exposure, of the vehicle's own time
};

/// Port: the cameras of a vehicle that drives. They expose by a clock of their own, and only where
/// a code is expected below them; what they read is known some time after that.
class WaySensing {
public:
    virtual ~WaySensing() = default;
    /// Time passes by `own_s`: exposes if it is time to, where `hall_from_body`, the pose now as
    /// believed, puts one of the `expected` codes into view, and gives what is read meanwhile.
    virtual std::vector<WayReading> look_below(std::span<const vda5050::SurveyedMarker> expected,
                                               const geometry::Pose2& hall_from_body,
                                               double own_s) = 0;
};

}  // namespace pulseline::onboard
