#pragma once

#include "core/geometry/pose2.hpp"
#include "core/kinematics/wheels.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::onboard {

using geometry::Pose2;

/// Where a vehicle should be that is steered by twists instead of along a path: a point that takes
/// on the twist asked for as fast as the type's accelerations allow. Way and turn change in the
/// same proportion, so that a vehicle that brakes stays on its circle and its wheels keep their
/// directions. Deterministic, without any error.
class TwistReference {
public:
    /// Speeds of `type` are multiplied by `time_factor`, accelerations by its square.
    TwistReference(const plant::VehicleType& type, double time_factor);

    /// Drives with this twist (body frame, slowed down to kinematics::within_limits) until the next
    /// call; a zero one brakes and, when it stands, ends it. Begins at `from` when not active().
    void ask(const Pose2& from, const kinematics::Twist& twist);
    /// One step towards this share of the twist asked for.
    void step(double h_s, double share);
    /// It stands at once, where it is.
    void stand() { twist_ = {}; }
    /// Ends it at once. REQUIRES: standing().
    void drop();
    /// It has turned out to be elsewhere (hall frame): `by` times its pose.
    void shift(const Pose2& by) { pose_ = by * pose_; }

    bool active() const { return active_; }
    bool standing() const { return twist_ == kinematics::Twist{}; }
    const Pose2& pose() const { return pose_; }
    const kinematics::Twist& twist() const { return twist_; }
    const kinematics::Twist& asked() const { return asked_; }
    /// Way needed to brake now.
    double braking_m() const;

private:
    void end_if_done() { active_ = active_ && !(standing() && asked_ == kinematics::Twist{}); }

    plant::VehicleType type_;
    double time_factor_;
    double max_accel_mps2_;
    double max_turn_accel_radps2_;
    bool active_ = false;
    Pose2 pose_;
    kinematics::Twist twist_;
    kinematics::Twist asked_;
};

}  // namespace pulseline::onboard
