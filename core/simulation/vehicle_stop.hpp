#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/control/adjustment.hpp"
#include "core/fleet/state/vehicle_messages.hpp"
#include "core/simulation/drive.hpp"
#include "core/simulation/window_approach.hpp"

namespace pulseline::simulation {

/// Port: what the cameras of a vehicle that stands or creeps make of the codes below it.
class StopSensing {
public:
    virtual ~StopSensing() = default;
    /// Pose of the body in the hall frame from the codes of `target` now in view. Reason codes:
    /// no_marker_in_view, and those of the localisation.
    virtual Result<fleet::StopMeasurement> measure(const fleet::StopTarget& target) = 0;
};

/// Measuring a stop, or correcting it until it is good (measureStop, adjustToMarker): from some
/// millimetres away a WindowApproach where that helps, then the loop of control::Adjustment, whose
/// motion compensation learns from every pass. The believed pose becomes each measured one; when
/// the first look found nothing, also those that it gets on the way to where the codes should be.
/// Refused with what was reached: as control::Adjustment does, and out_of_time.
class StopProcedure {
public:
    struct Outcome {
        bool succeeded = false;
        std::optional<fleet::StopMeasurement> measurement;  // the last one, also when it failed
        std::string why_not;
    };

    /// `limits`: how far the vehicle may move without being asked where it is released to go;
    /// `compensation`: what was learned of it before.
    StopProcedure(Drive& motion, StopSensing& sensing, const control::AdjustmentLimits& limits = {},
                  control::MotionCompensation compensation = {});

    /// REQUIRES: the motion is idle.
    void start(const fleet::StopTarget& target, bool correct);
    /// The outcome once it is over.
    std::optional<Outcome> step(double dt_s);
    bool running() const { return running_; }
    const control::MotionCompensation& compensation() const { return compensation_; }
    /// Gives up; a correction under way is braked first: running() until it stands.
    void abort();

private:
    std::optional<Outcome> take_measurement();
    /// The next pass of `loop`.
    Status begin_pass(control::Adjustment& loop, const Pose2& body_from_target);
    void drive_approach(double dt_s);
    void look_on_the_way();
    bool begin_approach(const Pose2& body_from_target);
    bool look_where_it_should_be();
    Status too_late(const Pose2& body_from_target) const;
    void learn(const fleet::StopMeasurement& after);
    Outcome finish(bool succeeded, std::string why_not);

    Drive& motion_;
    StopSensing& sensing_;
    control::AdjustmentLimits limits_;
    control::AdjustmentLimits target_limits_;  // of this stop
    control::MotionCompensation compensation_;
    control::Adjustment adjustment_;
    fleet::StopTarget target_;
    bool correct_ = false;
    bool running_ = false;
    bool aborting_ = false;
    std::optional<WindowApproach> approach_;
    int approaches_ = 0;
    bool on_the_way_ = false;  // seen on the way where it is
    bool late_ = false;        // the last approach timed out
    double tick_s_ = 0;        // own time of the last step
    double looked_at_m_ = 0;   // left to the target when it last looked on the way
    double settling_s_ = 0;
    int blind_passes_ = 0;
    std::optional<fleet::StopMeasurement> last_;
    std::optional<Pose2> arrived_;       // seen first, where the drive had ended
    std::vector<control::Move> driven_;  // since last_, as commanded
};

}  // namespace pulseline::simulation
