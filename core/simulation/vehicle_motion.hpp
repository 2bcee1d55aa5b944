#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <span>

#include "core/kinematics/motion.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// What separates the true motion of a platform from what its odometry believes: standard
/// deviations of seeded errors. The defaults end a 20 m drive typically 3 to 8 mm and some
/// hundredths of a degree off, as Tang 2020 measured before correcting.
struct MotionErrors {
    double distance_scale = 1.5e-4;   // encoder scale, constant per vehicle
    double turn_scale = 3e-4;         // same for turns
    double steering_bias_rad = 6e-5;  // wheels not quite parallel, constant per vehicle
    double slip_m_per_sqrt_m = 3e-4;  // wheel slip, random walk along and across
    double heading_rad_per_sqrt_m = 9e-5;
    double heading_rad_per_sqrt_rad = 2e-4;
    double settle_m = 1e-3;  // sag of the chassis when it brakes from full speed
    double settle_rad = 1.1e-3;
    // Corrective moves: scale and offset along the move are constant per vehicle and kind of move
    // (ahead, sideways, turn), which can be learned; the rest is new in each move.
    double fine_scale = 0.03;
    double fine_offset_m = 3e-4;
    double fine_offset_rad = 0.01 * kPi / 180;
    double fine_m = 2e-4;  // along and across
    double fine_rad = 0.005 * kPi / 180;
};

/// A simulated platform: the true pose and the pose its odometry believes. It drives a queue of
/// segments with trapezoidal speed profile, passing from one to the next without a stop where the
/// motion continues in the same kind and direction, and always able to stop at the queue's end.
/// Deterministic: the same seed and steps give the same poses.
class VehicleMotion {
public:
    /// Speeds are multiplied by `time_factor`, accelerations by its square.
    VehicleMotion(plant::VehicleType type, const Pose2& true_pose, std::uint64_t seed,
                  double time_factor = 1, const MotionErrors& errors = {});

    /// Adds a segment at the end of the queue. max_speed_mps 0: the vehicle's own limit.
    void append(const kinematics::Segment& segment, double max_speed_mps = 0);
    /// Small corrective moves one after the other at creeping speed; they do not count as segments
    /// done. REQUIRES: idle(); the first segment begins at believed_pose().
    void correct(std::span<const kinematics::Segment> moves);
    /// Brakes and stays; release() drives on.
    void hold() { held_ = true; }
    void release() { held_ = false; }
    /// Drops the queue. REQUIRES: standing().
    void clear();
    void step(double dt_s);

    bool standing() const { return speed_ == 0; }
    bool idle() const { return standing() && queue_.empty(); }
    /// Appended segments driven to their end since construction.
    std::size_t segments_done() const { return segments_done_; }
    /// Way of the body left in the queue, and the share of it needed to brake now.
    double remaining_m() const;
    double braking_m() const;
    /// Way since the current segment began.
    double distance_on_segment_m() const;
    /// The segment being driven or next to drive; nullptr when there is none.
    const kinematics::Segment* current() const;

    const Pose2& true_pose() const { return true_; }
    const Pose2& believed_pose() const { return believed_; }
    void set_believed(const Pose2& pose) { believed_ = pose; }
    const plant::VehicleType& type() const { return type_; }
    double time_factor() const { return time_factor_; }
    /// Along the motion, negative backwards; 0 in a turn on the spot.
    double velocity_mps() const;
    double turn_rate_radps() const;

private:
    struct Move {
        kinematics::Segment segment;
        double size = 0;      // metres of way, radians for a turn on the spot
        double max_rate = 0;  // of size per second
        double max_accel = 0;
        double done = 0;  // of size
        bool corrective = false;
        // What a corrective move truly comes to, of the motion believed: ahead, sideways, turned.
        std::array<double, 3> true_share{1, 1, 1};
    };
    /// How a vehicle's corrective moves of one kind differ from what is commanded.
    struct FineError {
        double scale = 1;
        double offset = 0;  // along the move
        double share_of(double size) const;
    };

    Move make_move(const kinematics::Segment& segment, double max_speed_mps) const;
    void substep(double h_s);
    double allowed_rate(double h_s) const;
    void advance(double way);
    void displace(Move& move, double way);
    void finish_front();
    void settle();
    double normal(double sigma) { return sigma * unit_normal_(random_); }

    plant::VehicleType type_;
    double time_factor_;
    MotionErrors errors_;
    std::mt19937_64 random_;
    std::normal_distribution<double> unit_normal_;
    double distance_scale_ = 0;
    double turn_scale_ = 0;
    double steering_bias_rad_ = 0;
    std::array<FineError, 3> fine_;  // ahead, sideways, turn

    Pose2 true_;
    Pose2 believed_;
    std::deque<Move> queue_;
    double speed_ = 0;  // rate of the front move's size
    double peak_speed_ = 0;
    bool held_ = false;
    std::size_t segments_done_ = 0;
};

/// True when a platform passes from `a` to `b` without stopping: straight on, the same arc, or the
/// same turn on the spot.
bool continues(const kinematics::Segment& a, const kinematics::Segment& b);

}  // namespace pulseline::simulation
