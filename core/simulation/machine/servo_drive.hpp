#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/onboard/motion/wheel_drive.hpp"
#include "core/simulation/machine/simulated_drive.hpp"
#include "core/simulation/machine/wheels_on_floor.hpp"

namespace pulseline::simulation {

/// The vehicle's own drive on simulated wheels: what the wheels' encoders tell gives the believed
/// pose, the floor gives the true one.
class ServoDrive final : public SimulatedDrive {
public:
    /// REQUIRES: `type` has a driven wheel. Speeds are multiplied by `time_factor`, accelerations
    /// by its square.
    ServoDrive(const plant::VehicleType& type, const Pose2& true_pose, std::uint64_t seed,
               double time_factor = 1, double load_kg = 0,
               const localisation::ErrorBudget& errors = localisation::ErrorBudget::nominal())
        : wheels_(type, true_pose, seed, load_kg, errors),
          drive_(type, wheels_, true_pose, time_factor) {}
    // The drive knows where its wheels are.
    ServoDrive(const ServoDrive&) = delete;
    ServoDrive& operator=(const ServoDrive&) = delete;

    void append(const kinematics::Segment& segment, double max_speed_mps = 0) override {
        drive_.append(segment, max_speed_mps);
    }
    void correct(std::span<const kinematics::Segment> moves) override { drive_.correct(moves); }
    void steer(const kinematics::Twist& twist) override { drive_.steer(twist); }
    void hold() override { drive_.hold(); }
    void release() override { drive_.release(); }
    void slow_to(double share) override { drive_.slow_to(share); }
    void clear() override { drive_.clear(); }
    void step(double dt_s) override { drive_.step(dt_s); }

    bool standing() const override { return drive_.standing(); }
    bool idle() const override { return drive_.idle(); }
    std::size_t rests() const override { return drive_.rests(); }
    std::size_t segments_done() const override { return drive_.segments_done(); }
    double remaining_m() const override { return drive_.remaining_m(); }
    double braking_m() const override { return drive_.braking_m(); }
    double run_ahead_m() const override { return drive_.run_ahead_m(); }
    double distance_on_segment_m() const override { return drive_.distance_on_segment_m(); }
    const kinematics::Segment* current() const override { return drive_.current(); }

    const Pose2& true_pose() const override { return wheels_.true_pose(); }
    void carry(const Pose2& by) override { wheels_.carry(by); }
    void set_load(double load_kg) override { wheels_.set_load(load_kg); }
    void set_hot(std::size_t wheel, bool hot) override { wheels_.set_hot(wheel, hot); }
    const Pose2& believed_pose() const override { return drive_.believed_pose(); }
    void set_believed(const Pose2& pose) override { drive_.set_believed(pose); }
    const plant::VehicleType& type() const override { return drive_.type(); }
    double time_factor() const override { return drive_.time_factor(); }
    double velocity_mps() const override { return drive_.velocity_mps(); }
    double turn_rate_radps() const override { return drive_.turn_rate_radps(); }
    kinematics::Twist twist() const override { return drive_.twist(); }
    std::vector<kinematics::WheelMotion> wheels() const override { return drive_.wheels(); }
    std::optional<Reason> stop_cause() const override { return drive_.stop_cause(); }
    void acknowledge() override { drive_.acknowledge(); }

    // Faults and floor, from outside. False: there is no such wheel.
    bool break_wheel(const std::string& name) { return wheels_.break_wheel(name); }
    bool kill_encoder(const std::string& name) { return wheels_.kill_encoder(name); }
    bool set_slip(const std::string& wheel, double share) { return wheels_.set_slip(wheel, share); }
    void set_grade(geometry::Point2 grade) { wheels_.set_grade(grade); }

private:
    WheelsOnFloor wheels_;
    onboard::WheelDrive drive_;
};

}  // namespace pulseline::simulation
