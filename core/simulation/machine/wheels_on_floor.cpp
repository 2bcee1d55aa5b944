#include "core/simulation/machine/wheels_on_floor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/kinematics/rolling_wheels.hpp"

namespace pulseline::simulation {
namespace {

using kinematics::WheelMotion;

constexpr double kScrubTurn_rad = 0.1;  // turned further, standing, wheels push the vehicle aside

}  // namespace

WheelsOnFloor::WheelsOnFloor(const plant::VehicleType& type, const Pose2& true_pose,
                             std::uint64_t seed, double load_kg,
                             const localisation::ErrorBudget& errors)
    : max_speed_mps_(type.max_speed_mps),
      cycle_s_(type.control.cycle_s),
      errors_(errors.drive),
      random_(seed),
      wheels_(type, load_kg, errors.drive, random_),
      contact_(type, load_kg, errors.drive, random_),
      measuring_(type, errors.slip_sensor, random_),
      true_(true_pose),
      accel_mps2_(type.wheels.size()),
      grade_n_(type.wheels.size()) {}

void WheelsOnFloor::steer(std::span<const WheelMotion> wanted) {
    if (!std::ranges::equal(steered_to_, wanted)) {
        steered_to_.assign(wanted.begin(), wanted.end());
        if (!wheels_.aligned(wanted, kScrubTurn_rad)) {
            true_ = true_ * Pose2{normal(errors_.scrub_m), normal(errors_.scrub_m), 0};
        }
    }
    wheels_.cycle(wanted, true, grade_n_);
}

void WheelsOnFloor::roll(std::span<const WheelMotion> wanted) {
    steered_to_.clear();
    contact_.grade_forces(wheels_.rolled(), true_, grade_n_);
    wheels_.cycle(wanted, false, grade_n_);
    for (std::size_t i = 0; i < accel_mps2_.size(); ++i) accel_mps2_[i] = wheels_.accel_mps2(i);
    true_twist_ = contact_.body_twist(wheels_.rolled(), accel_mps2_, true_, cycle_s_, random_);
    true_ = kinematics::moved(true_, true_twist_, cycle_s_);
    peak_mps_ = std::max(peak_mps_, std::hypot(true_twist_.vx_mps, true_twist_.vy_mps));
    slip_share_ = measuring_.slip_share(wheels_.measured(), contact_.rolling(), true_twist_,
                                        cycle_s_, random_);
}

void WheelsOnFloor::brake() {
    wheels_.brake();
    const double share = std::min(1.0, std::exchange(peak_mps_, 0) / max_speed_mps_);
    const double settle_m = errors_.fine_m + share * errors_.settle_m;
    const double settle_rad = errors_.fine_rad + share * errors_.settle_rad;
    true_ = true_ * Pose2{normal(settle_m), normal(settle_m), normal(settle_rad)};
    true_twist_ = {};
    slip_share_.reset();
    steered_to_.clear();
    measuring_.rest();
}

}  // namespace pulseline::simulation
