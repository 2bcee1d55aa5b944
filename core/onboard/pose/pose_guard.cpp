#include "core/onboard/pose/pose_guard.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::onboard {
namespace {

constexpr double kReachSigmas = 3;
// Of what is held; the rest of it is for braking.
constexpr double kSlowFrom = 0.75;
constexpr double kStandFrom = 0.97;
// Of what is held: by no more may the drive have to be led when a way begins.
constexpr double kLedBefore = 0.5;

}  // namespace

PoseGuard::PoseGuard(const plant::VehicleType& type, bool loaded) {
    for (const auto& piece : plant::outline_with_load(type, loaded)) {
        for (const auto& corner : piece) radius_m_ = std::max(radius_m_, norm(corner));
    }
}

double PoseGuard::unknown_m(const PoseEstimate& estimate) const {
    return kReachSigmas *
           std::hypot(estimate.sigma_xy_m(), radius_m_ * estimate.sigma_heading_rad());
}

double PoseGuard::reach_m(const PoseEstimate& estimate) const {
    return unknown_m(estimate) + to_lead_m(estimate);
}

double PoseGuard::to_lead_m(const PoseEstimate& estimate) const {
    const auto to_lead = estimate.to_lead();
    return norm(to_lead.position()) + radius_m_ * std::abs(to_lead.heading_rad);
}

bool PoseGuard::should_be_led(const PoseEstimate& estimate) const {
    return to_lead_m(estimate) > kLedBefore * kHeld_m;
}

bool PoseGuard::is_vague(const PoseEstimate& estimate) const {
    return unknown_m(estimate) > kStandFrom * kHeld_m;
}

PoseGuard::Advice PoseGuard::step(double dt_s, const PoseEstimate& estimate, Way way) {
    const double reach = way == Way::kToBegin ? unknown_m(estimate) : reach_m(estimate);
    if (reach > kStandFrom * kHeld_m && way != Way::kNone) {
        looked_s_ += dt_s;
        const double patience_s = way == Way::kToBegin ? kFind_s : kLook_s;
        return looked_s_ <= patience_s ? Advice::kLookAround : Advice::kAsk;
    }
    looked_s_ = 0;
    return reach > kSlowFrom * kHeld_m ? Advice::kDriveSlowly : Advice::kDrive;
}

double speed_share(PoseGuard::Advice advice) {
    switch (advice) {
        case PoseGuard::Advice::kDrive:
            return 1;
        case PoseGuard::Advice::kDriveSlowly:
            return PoseGuard::kSlowShare;
        default:
            return 0;
    }
}

}  // namespace pulseline::onboard
