#pragma once

#include <vector>

#include "core/control/adjustment.hpp"
#include "core/control/dynamic_window.hpp"
#include "core/control/scan.hpp"
#include "core/onboard/drive.hpp"

namespace pulseline::onboard {

/// The way to a target near by, driven by control::DynamicWindow (Li 2022, eq. 11 to 14): where the
/// vehicle is comes from its last measured pose, carried on by odometry (Drive::believed_pose()).
/// Way and turn are driven at once, where moves are driven one by one at creeping speed.
///
/// What it brings, as mean own time of a whole stop from random deviations (50 seeds, ticks of
/// 20 ms; moves only -> window, then the adjustment loop):
///                            8 mm, 0.08 deg     30 mm, 0.3 deg     95 mm, 0.9 deg
///   Mecanum, by its wheels   1.47 -> 1.39 s     2.03 -> 1.80 s     3.10 -> 2.51 s
///   Mecanum, statistical     1.08 -> 1.05 s     1.49 -> 1.35 s     2.52 -> 1.97 s
///   platform, by its wheels  4.97 -> 3.75 s     6.07 -> 5.27 s     7.47 -> (8.38) s
///   platform, statistical    1.31 -> 1.22 s     1.92 -> 1.68 s     3.19 -> (2.69) s
/// Where it is slower it is not used: by platforms from farther away, whose wheels must be steered
/// standing again and again as turn and way change their ratio; for stops finer than it ends,
/// 0.4 to 0.7 mm off, which need moves anyway, and moves that have been learned; and by
/// differential vehicles, which would have to turn to the target by more than the reach allows.
///
/// The reach stays that of the moves, 0.1 m and 1 deg, or where the vehicle was seen first if that
/// is farther off: the floor a vehicle has at a stop is its outline and traffic's margin of 0.1 m
/// (core/fleet/tables/floor_graph.hpp), and beside it every way but the one back leads farther off.
///
/// One object drives one approach.
class WindowApproach {
public:
    enum class State {
        kDriving,
        kReached,   // as it believes
        kStopped,   // it could not go on inside the reach
        kTimedOut,  // it has been driving for kPatience_s
    };
    static constexpr double kStep_s = 0.05;     // of the vehicle's own time, between two twists
    static constexpr double kLongest_s = 0.15;  // ticks coarser than that do not steer
    static constexpr double kPatience_s = 20;   // own time; a tenth of a metre takes two

    /// Whether it brings the vehicle there sooner than moves do (see above). `tick_s`: own time
    /// between two calls of step(); coarse ones are worth it from farther away only.
    static bool helps(const plant::VehicleType& type, const Pose2& body_from_target,
                      const control::AdjustmentLimits& limits, double tick_s);

    /// `limits`: ends well inside what is good and stays within reach of the target. `seen`: what
    /// the scanners see, kept up to date by who owns it: it keeps away from that (eq. 11's
    /// distance); null: nothing is seen. `motion` must outlive it and be idle.
    WindowApproach(Drive& motion, const Pose2& hall_from_target,
                   const control::AdjustmentLimits& limits,
                   const std::vector<control::Scan>* seen = nullptr);

    /// After each step of the motion by `dt_s`. Once it is not kDriving the vehicle brakes.
    State step(double dt_s);

private:
    State end(State state);
    void gather_things();

    Drive& motion_;
    Pose2 hall_from_target_;
    control::AdjustmentLimits limits_;
    control::DynamicWindow window_;
    const std::vector<control::Scan>* seen_;
    std::vector<geometry::Point2> things_;  // body frame
    kinematics::Twist asked_;               // in the vehicle's own time
    double until_step_s_ = 0;               // own time, as the next two
    double driven_s_ = 0;
};

}  // namespace pulseline::onboard
