#pragma once

#include <Eigen/Core>

#include "core/localisation/beacon_fix.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/pose/pose_estimate.hpp"

namespace pulseline::onboard {

/// Poses by beacons correct the one that the vehicle steers by. What contradicts the way driven is
/// refused, unless it keeps saying the same: then the wheels have slipped, or the vehicle was
/// moved, for a pose by beacons is checked in itself. MarkerWatch leads the drive to the corrected
/// pose. Thread safety: none.
class BeaconCorrection {
public:
    /// `clock_s`: sigma of the senses' stamps against the wheels'. All must outlive it.
    BeaconCorrection(const Drive& drive, PoseEstimate& estimate, double clock_s)
        : drive_(drive), estimate_(estimate), clock_s_(clock_s) {}

    /// Adds to a fix what it may be off because stamps do not quite agree while the vehicle drives.
    void blur(localisation::PoseFix& fix) const;
    enum class Taken { kCorrected, kRefused, kBegunAnew };
    /// A pose of now, by what was seen `seen_ago_s` before. One that is no `news`, since the noise
    /// of the one before is in it, only checks.
    Taken take(const localisation::BeaconFix& seen, double seen_ago_s, bool news = true);
    /// Poses refused in a row, all alike.
    int refused() const { return refused_; }

private:
    Eigen::Matrix3d odometry_since(double heading_rad, double seen_ago_s) const;

    const Drive& drive_;
    PoseEstimate& estimate_;
    double clock_s_;
    int refused_ = 0;
    geometry::Pose2 refused_by_;  // off the pose that the way driven gives
};

}  // namespace pulseline::onboard
