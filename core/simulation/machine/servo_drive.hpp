#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/simulation/machine/measuring_wheels.hpp"
#include "core/simulation/machine/path_reference.hpp"
#include "core/simulation/machine/simulated_drive.hpp"
#include "core/simulation/machine/wheel_contact.hpp"
#include "core/simulation/machine/wheel_set.hpp"

namespace pulseline::simulation {

/// A drive wheel by wheel: path tracking, servo axes, contact with the floor, odometry. The wheels'
/// encoders give the believed pose, which follows the reference; the floor gives the true one.
/// Before it moves from rest in a new direction it steers its wheels standing. When a wheel fails,
/// wheels and floor disagree, or it leaves its path, it brakes on the path and stays
/// (stop_cause()).
/// Encoders alone cannot see a wheel that slips at the commanded speed: measuring wheels show it,
/// where the type has them.
/// Physics runs in the vehicle's own time, in cycles of ServoAxis::kCycle_s: with a time factor the
/// same motion happens faster. Deterministic: the same seed and calls give the same poses.
class ServoDrive final : public SimulatedDrive {
public:
    /// REQUIRES: `type` has a driven wheel. Speeds are multiplied by `time_factor`, accelerations
    /// by its square.
    ServoDrive(plant::VehicleType type, const Pose2& true_pose, std::uint64_t seed,
               double time_factor = 1, double load_kg = 0,
               const localisation::ErrorBudget& errors = localisation::ErrorBudget::nominal());

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

    const Pose2& true_pose() const override { return true_; }
    void carry(const Pose2& by) override { true_ = true_ * by; }
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

    // Faults and floor, from outside. False: there is no such wheel.
    bool break_wheel(const std::string& name) { return wheels_.break_wheel(name); }
    bool kill_encoder(const std::string& name) { return wheels_.kill_encoder(name); }
    /// Share of the rim's speed that is lost, 0.2 for 20 %.
    bool set_slip(const std::string& wheel, double share) {
        return contact_.set_slip(wheel, share);
    }
    /// Rise per metre along x and y of the hall.
    void set_grade(geometry::Point2 grade) { contact_.set_grade(grade); }

private:
    /// The first two stand.
    enum class Phase { kBraked, kSteering, kDriving, kSettling };

    void cycle();
    void begin();
    void choose_steering(const std::vector<kinematics::WheelMotion>& present);
    double steerable_way(std::size_t wheel, double angle_rad) const;
    void steer_standing();
    double reference_pace() const;
    void drive();
    void settle();
    void follow(const kinematics::Twist& twist);
    void turn_wheels(const std::vector<kinematics::WheelMotion>& wanted, bool standing);
    void watch_path();
    void watch_slip();
    void stop_for(Reason cause);
    void come_to_rest();
    double normal(double sigma) { return sigma * normal_(random_); }

    plant::VehicleType type_;
    double time_factor_;
    localisation::DriveErrors errors_;
    DriveLimits limits_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    WheelSet wheels_;
    WheelContact contact_;
    MeasuringWheels measuring_;
    kinematics::RollingWheels odometry_;
    PathReference reference_;  // in the vehicle's own time

    Pose2 true_;
    Pose2 believed_;
    Pose2 goal_;             // of the reference, also when it has ended
    std::deque<Pose2> due_;  // where the wheels can have brought it by now: older goals
    kinematics::BodyMotion told_;
    kinematics::Twist true_twist_;
    kinematics::Twist last_;  // asked for by the tracker while the reference moved
    std::vector<kinematics::WheelMotion> wanted_;
    std::vector<double> accel_mps2_;
    std::vector<double> grade_n_;

    Phase phase_ = Phase::kBraked;
    bool held_ = false;
    double speed_share_ = 1;
    bool must_steer_ = false;  // a wheel must be turned further than it can while driving
    double steerable_ = 0;     // way until then
    double pending_s_ = 0;     // own time not yet made into cycles
    double in_phase_s_ = 0;
    std::size_t rests_ = 0;
    double peak_mps_ = 0;
    double slipping_s_ = 0;
    std::optional<Reason> cause_;
};

}  // namespace pulseline::simulation
