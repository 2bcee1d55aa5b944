#pragma once

#include "core/control/adjustment.hpp"
#include "core/control/dynamic_window.hpp"
#include "core/simulation/drive.hpp"

namespace pulseline::simulation {

/// The way to a target near by, driven by control::DynamicWindow (Li 2022, section 3.3): where the
/// vehicle is comes from its last measured pose, carried on by odometry (Drive::believed_pose()).
/// One object drives one approach.
class WindowApproach {
public:
    enum class State {
        kDriving,
        kReached,   // as it believes
        kStopped,   // it could not go on inside the reach
        kTimedOut,  // something has held it up for kPatience_s
    };
    static constexpr double kStep_s = 0.05;     // of the vehicle's own time, between two twists
    static constexpr double kLongest_s = 0.1;   // steps coarser than that are not steered by
    static constexpr double kPatience_s = 20;   // own time; a tenth of a metre takes two

    /// Whether it is faster than moves one by one, or as fast and surer: the vehicle moves
    /// sideways, stands within reach, and is off by more than such moves repeat.
    static bool helps(const plant::VehicleType& type, const Pose2& body_from_target,
                      const control::AdjustmentLimits& limits);

    /// `limits`: ends well inside what is good and stays within reach of the target. `motion` must
    /// outlive it and be idle.
    WindowApproach(Drive& motion, const Pose2& hall_from_target,
                   const control::AdjustmentLimits& limits);

    /// After each step of the motion by `dt_s`. Once it is not kDriving the vehicle brakes.
    State step(double dt_s);

private:
    State end(State state);

    Drive& motion_;
    Pose2 hall_from_target_;
    control::AdjustmentLimits limits_;
    control::DynamicWindow window_;
    kinematics::Twist asked_;  // in the vehicle's own time
    double until_step_s_ = 0;  // own time, as the next two
    double driven_s_ = 0;
};

}  // namespace pulseline::simulation
