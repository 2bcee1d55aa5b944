#include "core/onboard/pose/beacon_correction.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/square.hpp"

namespace pulseline::onboard {
namespace {

using geometry::Point2;
using geometry::Pose2;
using localisation::BeaconFix;

// Poses that contradict the way driven, in a row and all alike: by chance there is not even one.
constexpr int kBelievedAfter = 5;
// What two of the same contradiction differ by: the noise of each, and what the clocks do.
constexpr double kAlike_m = 0.005;
constexpr double kAlike_rad = 0.003;
constexpr double kSigmas = 4;

bool alike(const Pose2& a, const Pose2& b, const localisation::PoseFix& fix) {
    return distance(a.position(), b.position()) <= kAlike_m + kSigmas * fix.sigma_xy_m &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) <=
               kAlike_rad + kSigmas * fix.sigma_heading_rad;
}

}  // namespace

void BeaconCorrection::blur(localisation::PoseFix& fix) const {
    const kinematics::Twist twist = drive_.twist();
    const Point2 off = Pose2{0, 0, fix.pose.heading_rad} * Point2{twist.vx_mps, twist.vy_mps};
    const Eigen::Vector3d error =
        clock_s_ / drive_.time_factor() * Eigen::Vector3d(off.x_m, off.y_m, twist.turn_radps);
    set_covariance(fix, localisation::matrix(fix.covariance) + error * error.transpose());
}

/// Of the way that the wheels have told since it was seen.
Eigen::Matrix3d BeaconCorrection::odometry_since(double heading_rad, double seen_ago_s) const {
    const kinematics::Twist twist = drive_.twist();
    const double way_m = std::hypot(twist.vx_mps, twist.vy_mps) / drive_.time_factor() * seen_ago_s;
    const auto& noise = estimate_.noise();
    const Eigen::Vector3d variance(square(noise.forward_m_per_sqrt_m) * way_m,
                                   square(noise.left_m_per_sqrt_m) * way_m,
                                   square(noise.heading_rad_per_sqrt_m) * way_m);
    const Eigen::AngleAxisd turned(heading_rad, Eigen::Vector3d::UnitZ());
    return turned.toRotationMatrix() * variance.asDiagonal() *
           turned.toRotationMatrix().transpose();
}

BeaconCorrection::Taken BeaconCorrection::take(const BeaconFix& seen, double seen_ago_s,
                                               bool news) {
    const Status agrees =
        news ? estimate_.see(seen, odometry_since(seen.fix.pose.heading_rad, seen_ago_s))
             : estimate_.check(seen);
    if (agrees) {
        refused_ = 0;
        return Taken::kCorrected;
    }
    // The way driven since moves both alike, so that the same contradiction stays the same.
    const Pose2 off = inverse(estimate_.pose()) * seen.fix.pose;
    refused_ = refused_ > 0 && alike(off, refused_by_, seen.fix) ? refused_ + 1 : 1;
    refused_by_ = off;
    if (refused_ < kBelievedAfter) return Taken::kRefused;
    estimate_.restart_at(seen);
    refused_ = 0;
    return Taken::kBegunAnew;
}

}  // namespace pulseline::onboard
