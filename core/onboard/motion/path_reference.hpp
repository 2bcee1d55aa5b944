#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <vector>

#include "core/kinematics/motion.hpp"
#include "core/kinematics/wheels.hpp"
#include "core/onboard/motion/twist_reference.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::onboard {

/// Where a vehicle should be: a point that drives a queue of segments with trapezoidal speed
/// profile, passing from one to the next without a stop where the motion continues in the same kind
/// and direction, and always able to stop at the queue's end. With nothing queued it can be steered
/// by twists instead. Deterministic, without any error.
class PathReference {
public:
    /// What one step covered of one segment.
    struct Passed {
        Pose2 from;
        Pose2 to;
        double way = 0;  // metres; radians of a turn on the spot
        bool on_the_spot = false;
        bool fine = false;      // of append_fine()
        bool finished = false;  // its end is reached
        bool rests = false;     // the profile comes to rest here
        double peak_rate = 0;   // of way per second, the highest since it last rested
    };

    /// Speeds of `type` are multiplied by `time_factor`, accelerations by its square.
    PathReference(plant::VehicleType type, double time_factor);

    /// Adds a segment at the end of the queue. max_speed_mps 0: the vehicle's own limit.
    void append(const kinematics::Segment& segment, double max_speed_mps = 0);
    /// The same at creeping speed; it does not count among the segments done.
    void append_fine(const kinematics::Segment& segment);
    /// Drives with this twist from `from`, or from where it is if it is steered already.
    /// REQUIRES: nothing is queued.
    void steer(const Pose2& from, const kinematics::Twist& twist);
    bool steered() const { return steered_.active(); }
    /// It has turned out to be elsewhere: `by` times its pose. REQUIRES: steered().
    void shift(const Pose2& by) { steered_.shift(by); }
    void hold() { held_ = true; }
    void release() { held_ = false; }
    bool held() const { return held_; }
    /// From now on at this share of every rate, 0 to 1; slowing down takes its time.
    void slow_to(double share) { rate_share_ = share; }
    /// It stands at once, where it is: its machine has braked without it.
    void stand() {
        rate_ = 0;
        steered_.stand();
    }
    /// Drops the queue, or what it is steered by. REQUIRES: standing().
    void clear();
    /// The pieces covered, in their order; valid until the next call.
    std::span<const Passed> step(double h_s);

    bool standing() const { return rate_ == 0 && steered_.standing(); }
    bool empty() const { return queue_.empty() && !steered_.active(); }
    std::size_t segments_done() const { return segments_done_; }
    double remaining_m() const;
    double braking_m() const;
    double run_ahead_m() const;
    double distance_on_segment_m() const;
    const kinematics::Segment* current() const;
    /// Where it is now, on the current segment or steered. REQUIRES: not empty().
    Pose2 pose() const;
    /// Body frame; derivative of its poses. Zero when empty or standing.
    kinematics::Twist twist() const { return steered() ? steered_.twist() : twist_at(rate_); }
    /// The twist it would have here at `share` of the current segment's highest rate, or of what it
    /// is steered by.
    kinematics::Twist twist_at_share(double share) const;

    /// What is left until it must rest, and the share of it needed to brake now; of the current
    /// segment's size, metres or radians.
    double run_ahead() const;
    double braking_way() const;
    /// The twist that far ahead on the run, driven at a rate of 1. REQUIRES: not empty().
    kinematics::Twist twist_ahead(double way) const;

    double velocity_mps() const;
    double turn_rate_radps() const;

private:
    struct Move {
        kinematics::Segment segment;
        double size = 0;      // metres of way, radians for a turn on the spot
        double max_rate = 0;  // of size per second
        double max_accel = 0;
        double done = 0;  // of size
        bool fine = false;
    };

    Move make_move(const kinematics::Segment& segment, double max_speed_mps) const;
    kinematics::Twist twist_at(double rate) const;
    double allowed_rate(double h_s) const;
    void advance(double way);
    void step_steered(double h_s);
    void finish_front(Passed passed);

    plant::VehicleType type_;
    double time_factor_;
    std::deque<Move> queue_;
    TwistReference steered_;
    kinematics::Segment steered_way_;  // asked for, as a segment of one second
    std::vector<Passed> passed_;
    double rate_ = 0;  // of the front move's size
    double peak_rate_ = 0;
    double rate_share_ = 1;
    bool held_ = false;
    std::size_t segments_done_ = 0;
};

/// True when a platform passes from `a` to `b` without stopping: straight on, the same arc, or the
/// same turn on the spot.
bool continues(const kinematics::Segment& a, const kinematics::Segment& b);
/// Body twist of the pose at share `s` of a segment that is driven in one second.
kinematics::Twist derivative(const kinematics::Segment& segment, double s);
/// No way of the body's centre: the segment is measured in radians.
bool turns_on_the_spot(const kinematics::Segment& segment);

}  // namespace pulseline::onboard
