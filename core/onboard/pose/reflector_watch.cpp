#include "core/onboard/pose/reflector_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pulseline::onboard {
namespace {

using localisation::BeaconFix;
using localisation::SeenReflector;

// Turns that fit nowhere near before it looks through the whole hall: somebody who walks by hides
// reflectors for less.
constexpr int kLooksAroundAfter = 8;
constexpr double kWorse = 1.01;

}  // namespace

ReflectorWatch::ReflectorWatch(NavigationScanner& scanner, const Drive& drive,
                               PoseEstimate& estimate, const OdometryTrail& trail,
                               const localisation::ReflectorErrors& errors)
    : scanner_(scanner),
      drive_(drive),
      estimate_(estimate),
      trail_(trail),
      correction_(drive, estimate, errors.clock_s),
      errors_(errors) {}

void ReflectorWatch::step(double dt_s, const std::vector<plant::Reflector>& reflectors,
                          bool located) {
    const auto turn = scanner_.take_turn(dt_s * drive_.time_factor());
    if (!turn) return;
    const auto seen = seen_in(*turn);
    tell(seen);
    newest_.reset();
    why_not_.reset();
    if (reflectors.empty() || !located) return;
    auto fix = fix_by(seen, reflectors);
    if (!fix) {
        why_not_ = fix.error();
        return;
    }
    correction_.blur(fix->fix);
    if (!drive_.standing()) told_standing_m_.reset();
    // Of a place that is less well known by now, somebody has said something else.
    const bool news = !told_standing_m_ || estimate_.sigma_xy_m() > kWorse * *told_standing_m_;
    switch (correction_.take(*fix, seen_ago_s_, news)) {
        case BeaconCorrection::Taken::kBegunAnew:
            without_ = 0;
            [[fallthrough]];
        case BeaconCorrection::Taken::kCorrected:
            if (drive_.standing()) told_standing_m_ = estimate_.sigma_xy_m();
            break;
        case BeaconCorrection::Taken::kRefused:
            break;
    }
    newest_ = std::move(*fix);
}

/// As the body stands now; it has driven on since the rays met them.
std::vector<SeenReflector> ReflectorWatch::seen_in(
    const std::vector<localisation::BrightEcho>& turn) {
    const plant::NavigationScanner& type = *drive_.type().navigation_scanner;
    std::vector<SeenReflector> seen;
    double ago_s = 0;
    for (const auto& sight : localisation::reflector_sights(turn, type, errors_)) {
        const double age_s = std::max(0.0, sight.age_s);
        if (!drive_.standing() && !trail_.remembers(age_s)) continue;
        const geometry::Pose2 way =
            drive_.standing() ? geometry::Pose2{} : trail_.now_from_then(age_s);
        seen.push_back(localisation::seen_reflector(sight, type, way));
        ago_s += age_s;
    }
    seen_ago_s_ = seen.empty() ? 0 : ago_s / static_cast<double>(seen.size());
    return seen;
}

Result<BeaconFix> ReflectorWatch::fix_by(const std::vector<SeenReflector>& seen,
                                         const std::vector<plant::Reflector>& reflectors) {
    const plant::NavigationScanner& type = *drive_.type().navigation_scanner;
    auto near = localisation::locate_by_reflectors(
        seen, reflectors, type, {estimate_.pose(), estimate_.covariance()}, errors_);
    if (near) {
        without_ = 0;
        return near;
    }
    if (++without_ < kLooksAroundAfter) return near;
    auto anywhere = localisation::find_by_reflectors(seen, reflectors, type, errors_);
    return anywhere ? anywhere : near;
}

void ReflectorWatch::tell(const std::vector<SeenReflector>& seen) {
    sights_.clear();
    for (const SeenReflector& one : seen) {
        sights_.push_back({one.in_body, std::sqrt(one.covariance.trace() / 2)});
    }
    std::ranges::sort(sights_, {}, [](const vda5050::ReflectorSight& sight) {
        return dot(sight.place, sight.place);
    });
    if (sights_.size() > vda5050::kMostReflectorSights)
        sights_.resize(vda5050::kMostReflectorSights);
}

}  // namespace pulseline::onboard
