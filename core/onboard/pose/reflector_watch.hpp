#pragma once

#include <optional>
#include <vector>

#include "core/localisation/reflector_pose.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/navigation_scanner.hpp"
#include "core/onboard/pose/beacon_correction.hpp"
#include "core/onboard/pose/odometry_trail.hpp"
#include "core/onboard/pose/pose_estimate.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Reflectors correct the pose that the vehicle steers by, each turn of its navigation scanner,
/// as BeaconCorrection says; standing, the same rays fall on them in the same way again, so that
/// the first turn tells all and the others only check it. While they do not fit to where it
/// believes to be, it looks for the place of the hall that they do fit to. Thread safety: none. No
/// clock: time passes by step().
class ReflectorWatch {
public:
    /// All must outlive it. REQUIRES: the drive's type has a navigation scanner.
    ReflectorWatch(NavigationScanner& scanner, const Drive& drive, PoseEstimate& estimate,
                   const OdometryTrail& trail, const localisation::ReflectorErrors& errors = {});

    /// After each step of the trail. Without a pose (`located`) it only tells what it sees.
    void step(double dt_s, const std::vector<plant::Reflector>& reflectors, bool located);

    /// Sights of the last turn, for the server.
    const std::vector<vda5050::ReflectorSight>& sights() const { return sights_; }
    /// The newest pose by reflectors; nothing: the last turn gave none.
    const std::optional<localisation::BeaconFix>& newest() const { return newest_; }
    /// Why not, as localisation::locate_by_reflectors and find_by_reflectors say; nothing: there is
    /// one, or it was told of no reflectors.
    const std::optional<Error>& why_not() const { return why_not_; }

private:
    std::vector<localisation::SeenReflector> seen_in(
        const std::vector<localisation::BrightEcho>& turn);
    Result<localisation::BeaconFix> fix_by(const std::vector<localisation::SeenReflector>& seen,
                                           const std::vector<plant::Reflector>& reflectors);
    void tell(const std::vector<localisation::SeenReflector>& seen);

    NavigationScanner& scanner_;
    const Drive& drive_;
    PoseEstimate& estimate_;
    const OdometryTrail& trail_;
    BeaconCorrection correction_;
    localisation::ReflectorErrors errors_;
    std::vector<vda5050::ReflectorSight> sights_;
    std::optional<localisation::BeaconFix> newest_;
    std::optional<Error> why_not_;
    int without_ = 0;  // turns in a row that did not fit
    /// Sigma of the place that a turn corrected last and that it stands at since; nothing: none
    /// has.
    std::optional<double> told_standing_m_;
    double seen_ago_s_ = 0;  // of the last turn's sights, on average
};

}  // namespace pulseline::onboard
