#pragma once

#include "core/kinematics/past_poses.hpp"
#include "core/onboard/drive.hpp"

namespace pulseline::onboard {

/// The way that a vehicle has driven lately by its wheels alone: what was seen is known some time
/// later, and the vehicle has driven on meanwhile.
class OdometryTrail {
public:
    /// No camera and no receiver takes longer.
    static constexpr double kRemembered_s = 0.5;

    explicit OdometryTrail(const Drive& drive) : drive_(drive), believed_(drive.believed_pose()) {}

    /// After each step of the drive. A pose told or measured meanwhile looks like a jump in the
    /// way; what lies before it is forgotten.
    void step(double own_s);
    /// Without a motion, the drive believes to be here from now on.
    void led_to(const Pose2& believed) { believed_ = believed; }

    /// By the drive, at the end of the last step.
    const Pose2& believed() const { return believed_; }
    /// The way driven since the beginning, by the wheels alone.
    const Pose2& driven() const { return odometry_; }
    bool remembers(double age_s) const { return past_.reach_back(age_s); }
    /// The body then, seen from the body now. REQUIRES: something is remembered.
    Pose2 now_from_then(double age_s) const { return inverse(odometry_) * past_.at(age_s); }

private:
    const Drive& drive_;
    Pose2 odometry_;  // the way driven, no correction in it
    Pose2 believed_;
    kinematics::PastPoses past_;  // of odometry_
};

}  // namespace pulseline::onboard
