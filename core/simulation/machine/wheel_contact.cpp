#include "core/simulation/machine/wheel_contact.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/gravity.hpp"

namespace pulseline::simulation {
namespace {

using geometry::Point2;
using kinematics::Twist;
using kinematics::WheelMotion;

constexpr double kNoWay_m = 1e-9;

plant::VehicleType misplaced(plant::VehicleType type, double sigma, std::mt19937_64& random) {
    std::normal_distribution<double> share(1, sigma);
    // One scale for all: what calibration leaves is the scale of turns.
    const double along = share(random);
    const double across = share(random);
    for (auto& wheel : type.wheels) {
        wheel.position = {wheel.position.x_m * along, wheel.position.y_m * across};
    }
    return type;
}

bool on_rollers(const plant::VehicleType& type) {
    return type.kinematics == plant::Kinematics::kMecanum;
}

}  // namespace

WheelContact::WheelContact(const plant::VehicleType& type, double load_kg,
                           const localisation::DriveErrors& errors, std::mt19937_64& random)
    : errors_(errors),
      type_(type),
      nominal_(type),
      actual_(misplaced(type, errors.wheel_place, random)),
      slip_(type.wheels.size()),
      driven_kg_(type.wheels.size()),
      contact_(type.wheels.size()) {
    set_load(load_kg);
    grade_ = {errors_.grade * normal_(random), errors_.grade * normal_(random)};
    if (on_rollers(type_)) roller_loss_ = errors_.roller_slip * normal_(random);
}

void WheelContact::set_load(double load_kg) {
    const auto driven =
        static_cast<double>(std::ranges::count_if(type_.wheels, &plant::Wheel::driven));
    for (std::size_t i = 0; i < driven_kg_.size(); ++i) {
        if (type_.wheels[i].driven) driven_kg_[i] = (type_.mass_kg + load_kg) / driven;
    }
}

bool WheelContact::set_slip(const std::string& wheel, double share) {
    for (std::size_t i = 0; i < type_.wheels.size(); ++i) {
        if (type_.wheels[i].name != wheel) continue;
        slip_[i] = share;
        return true;
    }
    return false;
}

void WheelContact::grade_forces(std::span<const WheelMotion> wheels, const Pose2& true_pose,
                                std::vector<double>& force_n) const {
    const Point2 down = inverse(Pose2{0, 0, true_pose.heading_rad}) * grade_;
    force_n.resize(wheels.size());
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        const double along =
            down.x_m * std::cos(wheels[i].angle_rad) + down.y_m * std::sin(wheels[i].angle_rad);
        force_n[i] = -driven_kg_[i] * kGravity_mps2 * along;
    }
}

Twist WheelContact::body_twist(std::span<const WheelMotion> rolled,
                               std::span<const double> accel_mps2, const Pose2& true_pose,
                               double h_s, std::mt19937_64& random) {
    const Point2 grade = inverse(Pose2{0, 0, true_pose.heading_rad}) * grade_;
    for (std::size_t i = 0; i < contact_.size(); ++i) {
        contact_[i] = rolled[i];
        double lost = slip_[i];
        if (driven_kg_[i] > 0) {
            // Force over weight: what accelerates the vehicle, and what holds it on the slope.
            const double uphill = grade.x_m * std::cos(rolled[i].angle_rad) +
                                  grade.y_m * std::sin(rolled[i].angle_rad);
            const double forward = rolled[i].speed_mps >= 0 ? 1 : -1;
            lost += forward * (accel_mps2[i] / kGravity_mps2 + uphill) / errors_.creep_stiffness;
        }
        if (patch_left_m_ > 0 && i == patch_wheel_) lost += errors_.patch_slip;
        contact_[i].speed_mps *= 1 - lost;
    }
    Twist twist = actual_.body_of(contact_).twist;

    const double speed = std::hypot(twist.vx_mps, twist.vy_mps);
    const double way_m = speed * h_s;
    const double turn_rad = std::abs(twist.turn_radps) * h_s;
    if (way_m + turn_rad < kNoWay_m) return twist;
    maybe_enter_patch(way_m, random);
    if (speed > 0) {
        // Tyres give way across, downhill.
        const Point2 left{-twist.vy_mps / speed, twist.vx_mps / speed};
        const double drift = -speed * dot(grade, left) / errors_.side_stiffness;
        twist.vx_mps += drift * left.x_m;
        twist.vy_mps += drift * left.y_m;
    }
    twist.vy_mps *= 1 - roller_loss_;
    const double root_m = std::sqrt(way_m) / h_s;
    const double across = on_rollers(type_) ? errors_.roller_wander : 1;
    twist.vx_mps += errors_.wander_m_per_sqrt_m * root_m * normal_(random);
    twist.vy_mps += across * errors_.wander_m_per_sqrt_m * root_m * normal_(random);
    twist.turn_radps +=
        errors_.wander_rad_per_sqrt_m * root_m * normal_(random) +
        errors_.wander_rad_per_sqrt_rad * std::sqrt(turn_rad) / h_s * normal_(random);
    return twist;
}

void WheelContact::maybe_enter_patch(double way_m, std::mt19937_64& random) {
    if (patch_left_m_ > 0) {
        patch_left_m_ -= way_m;
        return;
    }
    std::uniform_real_distribution<double> chance;
    if (chance(random) * errors_.patch_every_m >= way_m) return;
    patch_left_m_ = errors_.patch_m;
    patch_wheel_ = nominal_.index[random() % nominal_.index.size()];
}

}  // namespace pulseline::simulation
