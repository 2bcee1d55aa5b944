#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/onboard/motion/wheels.hpp"
#include "core/simulation/machine/measuring_wheels.hpp"
#include "core/simulation/machine/wheel_contact.hpp"
#include "core/simulation/machine/wheel_set.hpp"

namespace pulseline::simulation {

/// The wheels of a simulated vehicle on its floor: servo axes, creep, slip and slope move it, and
/// where it truly stands is known here. Deterministic: the same seed and calls give the same poses.
class WheelsOnFloor final : public onboard::Wheels {
public:
    /// REQUIRES: `type` has a driven wheel.
    WheelsOnFloor(const plant::VehicleType& type, const Pose2& true_pose, std::uint64_t seed,
                  double load_kg, const localisation::ErrorBudget& errors);

    void roll(std::span<const kinematics::WheelMotion> wanted) override;
    void steer(std::span<const kinematics::WheelMotion> wanted) override;
    /// The chassis sags.
    void brake() override;

    const std::vector<kinematics::WheelMotion>& present() const override {
        return wheels_.present();
    }
    const std::vector<kinematics::WheelMotion>& measured() const override {
        return wheels_.measured();
    }
    bool aligned(std::span<const kinematics::WheelMotion> wanted, double limit_rad) const override {
        return wheels_.aligned(wanted, limit_rad);
    }
    bool settled() const override { return wheels_.settled(); }
    std::optional<std::string> fault() const override { return wheels_.fault(); }
    std::optional<std::string> lagging() const override { return wheels_.lagging(); }
    void switch_off(const std::string& wheel) override { wheels_.switch_off(wheel); }
    std::optional<double> slip_share() const override { return slip_share_; }
    int dead_cycles() const override { return WheelSet::kDeadCycles; }

    /// The same object for as long as it lives.
    const Pose2& true_pose() const { return true_; }
    void carry(const Pose2& by) { true_ = true_ * by; }

    /// What the vehicle carries from now on. REQUIRES: it stands.
    void set_load(double load_kg) {
        wheels_.set_load(load_kg);
        contact_.set_load(load_kg);
    }

    void set_hot(std::size_t wheel, bool hot) { wheels_.set_hot(wheel, hot); }

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
    double normal(double sigma) { return sigma * normal_(random_); }

    double max_speed_mps_;
    double cycle_s_;
    localisation::DriveErrors errors_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    WheelSet wheels_;
    WheelContact contact_;
    MeasuringWheels measuring_;

    Pose2 true_;
    kinematics::Twist true_twist_;
    std::vector<kinematics::WheelMotion> steered_to_;  // standing; empty: since it rolled last
    std::vector<double> accel_mps2_;
    std::vector<double> grade_n_;
    std::optional<double> slip_share_;
    double peak_mps_ = 0;  // since it rested last
};

}  // namespace pulseline::simulation
