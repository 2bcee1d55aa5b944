#pragma once

#include <span>
#include <vector>

#include "core/base/result.hpp"
#include "core/kinematics/motion.hpp"
#include "core/kinematics/wheels.hpp"

/// Motions in time, down to what each wheel does.
namespace pulseline::kinematics {

/// What body and wheels do at one moment of a trajectory.
struct TrajectoryState {
    Pose2 pose;
    Twist twist;                      // body frame
    std::vector<WheelMotion> wheels;  // in the type's order
};

/// The most that any wheel does on the way.
struct WheelPeaks {
    double speed_mps = 0;     // of its rim
    double steering_rad = 0;  // to either side of straight ahead
};

/// Segments driven one after the other from rest to rest: before each run the vehicle stands while
/// its steered wheels turn, then it follows a trapezoidal profile within the limits of body and
/// wheels. Its duration is the sum of those that set_durations gives.
class Trajectory {
public:
    /// Fails with cannot_move_so as wheels_of does. `max_speed_mps`: one limit per segment, or
    /// none. REQUIRES: the type outlives the trajectory; each segment begins where the one before
    /// ends; no combined segment for a type with steered wheels, which would have to turn on the
    /// way.
    static Result<Trajectory> of(const plant::VehicleType& type,
                                 const std::vector<Segment>& segments,
                                 const std::vector<double>& max_speed_mps = {});

    double duration_s() const { return duration_s_; }
    /// At the ends outside [0, duration_s].
    TrajectoryState at(double time_s) const;
    /// On a combined segment, whose wheels change speed all the way, at 33 moments of its run.
    WheelPeaks wheel_peaks() const;

private:
    struct Run {
        std::vector<Segment> segments;
        double begin_s = 0;
        double steering_s = 0;
        double moving_s = 0;
        double size = 0;  // of way; radians for a turn on the spot
        double rate = 0;
        double accel = 0;
        std::vector<WheelMotion> before;  // wheels when the run before it has ended
        std::vector<WheelMotion> first;   // when it begins to move
    };

    explicit Trajectory(const plant::VehicleType& type) : type_(&type) {}
    TrajectoryState steering(const Run& run, double time_s) const;
    TrajectoryState moving(const Run& run, double time_s) const;

    const plant::VehicleType* type_;
    std::vector<Run> runs_;
    double duration_s_ = 0;
};

}  // namespace pulseline::kinematics
