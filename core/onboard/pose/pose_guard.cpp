#include "core/onboard/pose/pose_guard.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::onboard {
namespace {

constexpr double kReachSigmas = 3;
constexpr double kSlowFrom = 0.75;  // of what is held
// To the second code at least: those of lanes lie 9 m apart at most, and one can be missed.
constexpr double kFromAPerson_m = 25;

}  // namespace

PoseGuard::PoseGuard(const plant::VehicleType& type, bool loaded) {
    for (const auto& piece : plant::outline_with_load(type, loaded)) {
        for (const auto& corner : piece) radius_m_ = std::max(radius_m_, norm(corner));
    }
}

double PoseGuard::reach_m(const PoseEstimate& estimate) const {
    return kReachSigmas *
           std::hypot(estimate.sigma_xy_m(), radius_m_ * estimate.sigma_heading_rad());
}

PoseGuard::Advice PoseGuard::advice(const PoseEstimate& estimate) const {
    const double reach = reach_m(estimate);
    if (reach <= kSlowFrom * kHeld_m) return Advice::kDrive;
    if (reach <= kHeld_m) return Advice::kDriveSlowly;
    const auto said = estimate.driven_since_said_m();
    return said && *said <= kFromAPerson_m ? Advice::kDriveSlowly : Advice::kStay;
}

}  // namespace pulseline::onboard
