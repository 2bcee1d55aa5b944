#pragma once

#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/kinematics/rolling_wheels.hpp"
#include "core/localisation/error_budget.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// Between the wheels and the floor: creep, slip, slope and chance turn what the wheels roll into
/// how the body truly moves.
class WheelContact {
public:
    WheelContact(const plant::VehicleType& type, double load_kg,
                 const localisation::DriveErrors& errors, std::mt19937_64& random);

    void set_load(double load_kg);
    /// Twist of the body over a cycle of `h_s` at `true_pose`. `accel_mps2`: of each wheel's rim.
    kinematics::Twist body_twist(std::span<const kinematics::WheelMotion> rolled,
                                 std::span<const double> accel_mps2, const Pose2& true_pose,
                                 double h_s, std::mt19937_64& random);
    /// Slope along each wheel's rolling direction, as a force on it.
    void grade_forces(std::span<const kinematics::WheelMotion> wheels, const Pose2& true_pose,
                      std::vector<double>& force_n) const;

    /// Rise per metre along x and y of the hall.
    void set_grade(geometry::Point2 grade) { grade_ = grade; }
    /// Share of a wheel's rim speed that is lost; false: no such wheel.
    bool set_slip(const std::string& wheel, double share);
    /// Those that say how the body moves, among the vehicle's wheels.
    std::span<const std::size_t> rolling() const { return nominal_.index; }

private:
    void maybe_enter_patch(double way_m, std::mt19937_64& random);

    localisation::DriveErrors errors_;
    const plant::VehicleType type_;
    kinematics::RollingWheels nominal_;
    kinematics::RollingWheels actual_;  // wheels where they truly are
    std::vector<double> slip_;
    std::vector<double> driven_kg_;  // mass that each wheel pushes; 0: not driven
    std::vector<kinematics::WheelMotion> contact_;
    geometry::Point2 grade_;
    double roller_loss_ = 0;
    double patch_left_m_ = 0;
    std::size_t patch_wheel_ = 0;
    std::normal_distribution<double> normal_;
};

}  // namespace pulseline::simulation
