#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "core/kinematics/rolling_wheels.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/motion/drive_limits.hpp"
#include "core/onboard/motion/path_reference.hpp"
#include "core/onboard/motion/wheels.hpp"

namespace pulseline::onboard {

/// A drive wheel by wheel: a reference that drives the path, path tracking towards it, set points
/// for the wheels, and odometry from their encoders, which gives the believed pose. Before it moves
/// from rest in a new direction it steers its wheels standing. When a wheel fails, wheels and floor
/// disagree, or it leaves its path, it brakes on the path and stays (stop_cause()). Encoders alone
/// cannot see a wheel that slips at the commanded speed: measuring wheels show it, where the type
/// has them. All in the vehicle's own time, in the cycles of the type's control.
class WheelDrive final : public Drive {
public:
    /// `wheels` must outlive it. REQUIRES: `type` has a driven wheel. With a time factor, which
    /// only a simulated machine can have, the same motion happens faster: speeds are multiplied by
    /// it, accelerations by its square.
    WheelDrive(plant::VehicleType type, Wheels& wheels, const Pose2& believed,
               double time_factor = 1);

    void append(const kinematics::Segment& segment, double max_speed_mps = 0) override;
    void correct(std::span<const kinematics::Segment> moves) override;
    void steer(const kinematics::Twist& twist) override;
    void hold() override { held_ = true; }
    void release() override { held_ = false; }
    void slow_to(double share) override;
    void clear() override;
    void step(double dt_s) override;

    /// True while it only steers, too.
    bool standing() const override { return phase_ <= Phase::kSteering; }
    bool idle() const override { return phase_ == Phase::kBraked && reference_.empty(); }
    std::size_t rests() const override { return rests_; }
    std::size_t segments_done() const override { return reference_.segments_done(); }
    double remaining_m() const override { return reference_.remaining_m(); }
    double braking_m() const override { return reference_.braking_m(); }
    double run_ahead_m() const override { return reference_.run_ahead_m(); }
    double distance_on_segment_m() const override { return reference_.distance_on_segment_m(); }
    const kinematics::Segment* current() const override { return reference_.current(); }

    const Pose2& believed_pose() const override { return believed_; }
    void set_believed(const Pose2& pose) override;
    const plant::VehicleType& type() const override { return type_; }
    double time_factor() const override { return time_factor_; }
    double velocity_mps() const override { return time_factor_ * reference_.velocity_mps(); }
    double turn_rate_radps() const override { return time_factor_ * reference_.turn_rate_radps(); }
    /// As the encoders tell.
    kinematics::Twist twist() const override;
    std::vector<kinematics::WheelMotion> wheels() const override;
    std::optional<Reason> stop_cause() const override { return cause_; }
    void acknowledge() override;
    /// Its brakes are on, and it sends its wheels nothing.
    bool braked() const { return phase_ == Phase::kBraked; }

private:
    /// The first two stand.
    enum class Phase { kBraked, kSteering, kDriving, kSettling };

    void cycle();
    void lose_machine();
    void begin();
    void choose_steering(const std::vector<kinematics::WheelMotion>& present);
    double steerable_way(std::size_t wheel, double angle_rad) const;
    void steer_standing();
    double reference_pace() const;
    void drive();
    void settle();
    void follow(const kinematics::Twist& twist);
    void watch_path();
    void watch_slip();
    void stop_for(Reason cause);
    void come_to_rest();

    plant::VehicleType type_;
    Wheels& wheels_;
    double time_factor_;
    double cycle_s_;
    DriveLimits limits_;
    kinematics::RollingWheels odometry_;
    PathReference reference_;  // in the vehicle's own time

    Pose2 believed_;
    Pose2 goal_;             // of the reference, also when it has ended
    std::deque<Pose2> due_;  // where the wheels can have brought it by now: older goals
    kinematics::BodyMotion told_;
    kinematics::Twist last_;  // asked for by the tracker while the reference moved
    std::vector<kinematics::WheelMotion> wanted_;

    Phase phase_ = Phase::kBraked;
    bool held_ = false;
    double speed_share_ = 1;
    bool must_steer_ = false;  // a wheel must be turned further than it can while driving
    double steerable_ = 0;     // way until then
    double pending_s_ = 0;     // own time not yet made into cycles
    double in_phase_s_ = 0;
    std::size_t rests_ = 0;
    double slipping_s_ = 0;
    std::optional<Reason> cause_;
};

}  // namespace pulseline::onboard
