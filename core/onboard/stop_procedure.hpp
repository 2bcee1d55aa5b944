#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/control/adjustment.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/stop_sensing.hpp"
#include "core/onboard/window_approach.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Measuring a stop, or correcting it until it is good (measureStop, adjustToMarker): from some
/// millimetres away a WindowApproach where that helps, then the loop of control::Adjustment, whose
/// motion compensation learns from every pass. The believed pose becomes each measured one; when
/// the first look found nothing, also those that it gets on the way to where the codes should be
/// and, when they are not there either, while it searches (search_places). A vehicle that stands
/// farther off than small moves reach, and sees so, is brought back: it gets no farther off.
/// Refused with what was reached: as control::Adjustment does, and out_of_time.
class StopProcedure {
public:
    struct Outcome {
        bool succeeded = false;
        std::optional<vda5050::StopMeasurement> measurement;  // the last one, also when it failed
        std::string why_not;
    };

    /// `limits`: how far the vehicle may move without being asked where it is released to go;
    /// `compensation`: what was learned of it before.
    StopProcedure(Drive& motion, StopSensing& sensing, const control::AdjustmentLimits& limits = {},
                  control::MotionCompensation compensation = {});

    /// What the scanners see, kept up to date by who owns it, which must outlive this: approaches
    /// keep away from it.
    void see(const std::vector<control::Scan>& seen) { seen_ = &seen; }
    /// REQUIRES: the motion is idle.
    void start(const vda5050::StopTarget& target, bool correct);
    /// The outcome once it is over.
    std::optional<Outcome> step(double dt_s);
    bool running() const { return running_; }
    /// No code was in view where it should be, and it looks for one round there.
    bool searching() const { return running_ && to_search_ && !last_; }
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
    bool search();
    void reach_from(const Pose2& body_from_target);
    Status too_late(const Pose2& body_from_target) const;
    void learn(const vda5050::StopMeasurement& after);
    Outcome finish(bool succeeded, std::string why_not);

    Drive& motion_;
    StopSensing& sensing_;
    const std::vector<control::Scan>* seen_ = nullptr;
    control::AdjustmentLimits limits_;
    control::AdjustmentLimits target_limits_;  // of this stop
    control::MotionCompensation compensation_;
    control::Adjustment adjustment_;
    vda5050::StopTarget target_;
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
    std::optional<std::vector<Pose2>> to_search_;  // not looked from yet, last first
    std::optional<vda5050::StopMeasurement> last_;
    std::optional<Pose2> arrived_;       // seen first, where the drive had ended
    bool moved_unseen_ = false;          // since then, so that nobody knows where that was
    std::vector<control::Move> driven_;  // since last_, as commanded
};

}  // namespace pulseline::onboard
