#include "core/onboard/pose/contour_watch.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/square.hpp"

namespace pulseline::onboard {
namespace {

using geometry::Pose2;

// Driving it looks twenty times a second. What a look has in common with the one before is said by
// kLasting, but one that stands where that one was has seen nothing new.
constexpr double kEvery_s = 0.05;
constexpr double kRounding_s = 1e-9;
constexpr double kLeast_m = 0.01;
constexpr double kLeast_rad = 0.003;
constexpr int kLooksStanding = 12;
constexpr double kStillThere_s = 2;  // then it looks whether it is still there
// Around where it holds itself to be it looks a little wider: something may have moved it.
constexpr double kAround_m = 0.02;
constexpr double kAround_rad = 0.01;
// A map is no better than the poses that it was made with.
constexpr double kMap_m = 0.003;
constexpr double kMap_rad = 0.0003;
// Looks one after the other have nearly all in common, and more the nearer they are to each other:
// so much is new after this way.
constexpr double kLasting = 0.9;
constexpr double kNews_m = 0.15;
constexpr double kNews_rad = 0.05;
// Of what scanners meet, vehicles and people are not in the map.
constexpr double kExplained = 0.5;
constexpr int kFewestReturns = 12;
// Of rays that tell anything, those through what the map has: some things were taken away since.
constexpr double kThrough = 0.2;
// Where codes have told since the map was right last, the map is old; but not for longer than that.
constexpr double kWithoutCodes_m = 5;
// Looks in a row that contradict, each from another place while it drives: what somebody hides for
// a moment says nothing yet.
constexpr double kElsewhere_m = 0.15;
constexpr double kElsewhere_rad = 0.05;
// At its full speed a vehicle drives as far again while it brakes.
constexpr int kDoubtsAfter = 4;
constexpr int kLostAfter = 12;

Eigen::Matrix3d diagonal(double sigma_m, double sigma_rad) {
    return Eigen::Vector3d(square(sigma_m), square(sigma_m), square(sigma_rad)).asDiagonal();
}

}  // namespace

Eigen::Matrix3d way_covariance(const Pose2& way, const localisation::OdometryNoise& noise) {
    const double ahead_m = std::abs(way.x_m);
    const double left_m = std::abs(way.y_m);
    const double way_m = ahead_m + left_m;
    const double turn_rad = std::abs(way.heading_rad);
    const Eigen::Vector3d variance(
        square(noise.forward_m_per_sqrt_m) * ahead_m +
            square(noise.sideways_m_per_sqrt_m) * left_m + square(noise.scale * way_m),
        square(noise.left_m_per_sqrt_m) * ahead_m + square(noise.sideways_m_per_sqrt_m) * left_m +
            square(noise.crab_rad * way_m),
        square(noise.heading_rad_per_sqrt_m) * way_m +
            square(noise.heading_rad_per_sqrt_rad) * turn_rad +
            square(noise.bend_rad_per_m * way_m));
    return Eigen::Matrix3d(variance.asDiagonal()) + diagonal(noise.fine_m, noise.fine_rad);
}

ContourWatch::ContourWatch(Scanners& scanners, const Drive& drive, PoseEstimate& estimate,
                           const OdometryTrail& trail,
                           std::shared_ptr<const mapping::MatchedMap> map, std::uint64_t seed)
    : scanners_(scanners),
      drive_(drive),
      estimate_(estimate),
      trail_(trail),
      correction_(drive, estimate, 0),
      particles_(std::move(map), seed) {}

void ContourWatch::step(double dt_s, bool located) {
    if (!located) {
        begun_.reset();
        newest_.reset();
        explained_.reset();
        why_not_.reset();
        lacks_ = Lacks::kNothing;
        doubts_ = false;
        lost_ = false;
        return;
    }
    if (begun_ != estimate_.begun()) begin();
    if (is_due(dt_s)) look();
}

bool ContourWatch::is_due(double dt_s) {
    const Pose2 way = inverse(looked_from_) * trail_.driven();
    const bool moved = norm(way.position()) >= kLeast_m || std::abs(way.heading_rad) >= kLeast_rad;
    since_look_s_ += dt_s * drive_.time_factor();
    if (moved && !drive_.standing() && since_look_s_ >= kEvery_s - kRounding_s) {
        looks_standing_ = 0;
        since_look_s_ = std::min(since_look_s_ - kEvery_s, kEvery_s);  // steps need not divide it
        return true;
    }
    stood_s_ = drive_.standing() ? stood_s_ + dt_s * drive_.time_factor() : 0;
    const bool has_seen_all = looks_standing_ >= kLooksStanding;
    if (stood_s_ < (has_seen_all ? kStillThere_s : kStanding_s)) return false;
    looks_standing_ = std::min(looks_standing_ + 1, kLooksStanding + 1);
    return true;
}

void ContourWatch::begin() {
    begun_ = estimate_.begun();
    looked_from_ = trail_.driven();
    looks_standing_ = 0;
    contradicted_ = 0;
    by_codes_ = estimate_.by_codes();
    doubts_ = false;
    lost_ = false;
}

void ContourWatch::look() {
    const Pose2 way = inverse(looked_from_) * trail_.driven();
    news_share_ =
        std::clamp(std::max(norm(way.position()) / kNews_m, std::abs(way.heading_rad) / kNews_rad),
                   kLeast_m / kNews_m, 1.0);
    looked_from_ = trail_.driven();
    stood_s_ = 0;
    scanners_.scan(scans_);
    const auto look =
        particles_.look(estimate_.pose(), estimate_.covariance(), diagonal(kAround_m, kAround_rad),
                        diagonal(kMap_m, kMap_rad), scans_);
    newest_.reset();
    why_not_.reset();
    explained_.reset();
    lacks_ = look.returns < kFewestReturns ? Lacks::kThingsNear
             : look.check.everything       ? Lacks::kNothing
                                           : Lacks::kFeatures;
    if (look.returns < kFewestReturns) {
        doubts_ = false;  // nothing speaks for the map, nor against it
        return;
    }
    explained_ = look.explained;
    if (look.through > kThrough * (look.through + look.explained)) {
        why_not_ = Error{Errc::kConflict,
                         {"contours_lost", {{"through", look.through}}},
                         "The scanners see through what the map has here. Look whether the vehicle "
                         "stands where it believes to stand, or map the hall anew.",
                         {}};
        contradict();
        return;
    }
    contradicted_ = 0;
    doubts_ = false;
    lost_ = false;
    by_codes_ = estimate_.by_codes();
    if (look.explained >= kExplained) correct(look);
}

void ContourWatch::contradict() {
    looks_standing_ = 0;
    const bool codes_tell =
        by_codes_ != estimate_.by_codes() && estimate_.driven_since_m() < kWithoutCodes_m;
    const Pose2 way = inverse(contradicted_from_) * looked_from_;
    const bool elsewhere =
        norm(way.position()) >= kElsewhere_m || std::abs(way.heading_rad) >= kElsewhere_rad;
    if (contradicted_ == 0 || elsewhere || drive_.standing()) {
        ++contradicted_;
        contradicted_from_ = looked_from_;
    }
    doubts_ = contradicted_ >= kDoubtsAfter && !codes_tell;
    lost_ |= contradicted_ >= kLostAfter && !codes_tell;
}

void ContourWatch::correct(const mapping::MonteCarlo::Look& look) {
    const bool news = look.news.anything && looks_standing_ <= kLooksStanding;
    const auto& told = news ? look.news : look.check;
    if (!told.anything) return;
    localisation::BeaconFix fix;
    fix.fix.pose = told.pose;
    fix.fix.method = localisation::Method::kContours;
    // What is its own counts the less, the less of it is new.
    const double share = drive_.standing() ? 1 : news_share_;
    set_covariance(fix.fix, told.covariance + (1 - kLasting) * (1 / share - 1) * told.of_map);
    fix.lasting = localisation::rows(kLasting * told.of_map);
    if (correction_.take(fix, 0, news) == BeaconCorrection::Taken::kBegunAnew) {
        begun_ = estimate_.begun();
    }
    newest_ = std::move(fix);
}

}  // namespace pulseline::onboard
