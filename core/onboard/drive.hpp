#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "core/kinematics/motion.hpp"
#include "core/kinematics/wheels.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::onboard {

using geometry::Pose2;

/// Why a drive has stopped of itself (Drive::stop_cause).
namespace stop_causes {
inline constexpr const char* kWheelFault = "wheel_fault";        // {wheel}
inline constexpr const char* kSlip = "slip";                     // {share}
inline constexpr const char* kOffPath = "off_path";              // {distance_m}
inline constexpr const char* kMachineSilent = "machine_silent";  // the controller of its machine
}  // namespace stop_causes

/// Port: a vehicle's motion as its executor, its stops and its reports need it. It drives a queue
/// of segments and never past the queue's end, and knows the pose that its odometry believes.
/// Thread safety: none. No clock: time passes by step().
class Drive {
public:
    virtual ~Drive() = default;

    /// Adds a segment at the end of the queue. max_speed_mps 0: the vehicle's own limit.
    virtual void append(const kinematics::Segment& segment, double max_speed_mps = 0) = 0;
    /// Small moves from the believed pose, driven one after the other at creeping speed; they do
    /// not count as segments done. REQUIRES: idle().
    virtual void correct(std::span<const kinematics::Segment> moves) = 0;
    /// Drives with this twist from now on (body frame, slowed down to what the wheels can), taking
    /// it on as acceleration allows, until the next call; a zero one brakes. No segment is done by
    /// it. Not idle() until it stands with a zero one, or clear() ends it.
    /// REQUIRES: nothing queued; fixed wheels are not dragged sideways (kinematics::wheels_of).
    virtual void steer(const kinematics::Twist& twist) = 0;
    /// Brakes and stays; release() drives on.
    virtual void hold() = 0;
    virtual void release() = 0;
    /// From now on at this share of every speed, from 0, which brakes and waits, to 1.
    virtual void slow_to(double share) = 0;
    /// Drops the queue, or what it was steered by. REQUIRES: standing().
    virtual void clear() = 0;
    virtual void step(double dt_s) = 0;

    virtual bool standing() const = 0;
    /// Standing with nothing left in the queue, nor steered.
    virtual bool idle() const = 0;
    /// How often it has come to rest since construction, however shortly: its brakes fell in.
    virtual std::size_t rests() const = 0;
    /// Appended segments driven to their end since construction.
    virtual std::size_t segments_done() const = 0;
    /// Way of the body left in the queue, and the share of it needed to brake now.
    virtual double remaining_m() const = 0;
    virtual double braking_m() const = 0;
    /// Way of the body until it has to rest next: at the end of the queue, or before a move that it
    /// cannot go on into. 0 in a turn on the spot.
    virtual double run_ahead_m() const = 0;
    /// Way since the current segment began.
    virtual double distance_on_segment_m() const = 0;
    /// The segment being driven or next to drive; steered, what it was last asked for, for a
    /// second. nullptr when there is none.
    virtual const kinematics::Segment* current() const = 0;

    virtual const Pose2& believed_pose() const = 0;
    /// While it is steered it goes on from there; on segments it returns to them.
    virtual void set_believed(const Pose2& pose) = 0;
    virtual const plant::VehicleType& type() const = 0;
    /// How many times faster than the clock its own time passes; 1 but in simulation.
    virtual double time_factor() const = 0;

    /// Along the motion, negative backwards; 0 in a turn on the spot.
    virtual double velocity_mps() const = 0;
    virtual double turn_rate_radps() const = 0;
    /// Body frame, as the vehicle takes it to be.
    virtual kinematics::Twist twist() const = 0;
    /// One a wheel of the type, in its order; empty when the model has no wheels.
    virtual std::vector<kinematics::WheelMotion> wheels() const = 0;

    /// Why it has stopped of itself and stays, one of stop_causes. nullopt: it has not.
    virtual std::optional<Reason> stop_cause() const = 0;
    /// Somebody has looked: it drives on, unless what stopped it is still there.
    virtual void acknowledge() = 0;
};

}  // namespace pulseline::onboard
