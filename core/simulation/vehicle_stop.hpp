#pragma once

#include <optional>
#include <string>

#include "core/base/result.hpp"
#include "core/fleet/vehicle_messages.hpp"
#include "core/simulation/drive.hpp"

namespace pulseline::simulation {

/// Port: what the standing vehicle's cameras make of the codes below it.
class StopSensing {
public:
    virtual ~StopSensing() = default;
    /// Pose of the body in the hall frame from the codes of `target` now in view. Reason codes:
    /// no_marker_in_view, and those of the localisation.
    virtual Result<fleet::StopMeasurement> measure(const fleet::StopTarget& target) = 0;
};

/// Measuring a stop, or correcting it until it is good (measureStop, adjustToMarker). The believed
/// pose becomes each measured one.
class StopProcedure {
public:
    struct Outcome {
        bool succeeded = false;
        std::optional<fleet::StopMeasurement> measurement;  // the last one, also when it failed
        std::string why_not;
    };

    StopProcedure(Drive& motion, StopSensing& sensing) : motion_(motion), sensing_(sensing) {}

    /// REQUIRES: the motion is idle.
    void start(const fleet::StopTarget& target, bool correct);
    /// The outcome once it is over.
    std::optional<Outcome> step(double dt_s);
    bool running() const { return running_; }
    /// Gives up; a correction under way is braked first: running() until it stands.
    void abort();

private:
    std::optional<Outcome> take_measurement();
    void begin_correction(const Pose2& off);
    Outcome finish(bool succeeded, std::string why_not);

    Drive& motion_;
    StopSensing& sensing_;
    fleet::StopTarget target_;
    bool correct_ = false;
    bool running_ = false;
    bool aborting_ = false;
    double settling_s_ = 0;
    int corrections_ = 0;
    std::optional<fleet::StopMeasurement> last_;
};

}  // namespace pulseline::simulation
