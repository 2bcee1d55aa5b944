#include "core/onboard/pose/pose_estimate.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/square.hpp"
#include "core/localisation/covariance.hpp"

namespace pulseline::onboard {
namespace {

using geometry::Pose2;

// Shorter ways wait for the next one: most of the time nobody asks.
constexpr double kStep_m = 0.1;
constexpr double kStep_rad = 0.01;
// A person looks where the vehicle stands, and points at it on the map: 95 % within 0.1 m and 5
// deg.
constexpr double kToldSigma_m = 0.05;
constexpr double kToldSigma_rad = 0.044;
constexpr double kDoubtSigmas = 2;  // of what the wheels are said to err by
// Tang 2020: +-25 mm and +-0.2 deg.
constexpr double kTolerance_m = 0.025;
constexpr double kTolerance_rad = 0.2 * kPi / 180;

Eigen::Matrix3d known_to(double sigma_m, double sigma_rad) {
    return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad)
        .asDiagonal();
}

Eigen::Matrix3d told() { return known_to(kToldSigma_m, kToldSigma_rad); }

/// A way as the filter takes it: along and across the heading of half way, which is where the chord
/// of an arc points.
localisation::Odometry odometry_of(const Pose2& way) {
    const geometry::Point2 chord = Pose2{0, 0, -way.heading_rad / 2} * way.position();
    return {chord.x_m, chord.y_m, way.heading_rad};
}

/// What is wrong by so much where the body was, it is by so much after this motion in the hall: a
/// heading that is wrong leads beside the way.
Eigen::Matrix3d moved_on(const Eigen::Matrix3d& covariance, const Pose2& from, const Pose2& to) {
    Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
    motion(0, 2) = from.y_m - to.y_m;
    motion(1, 2) = to.x_m - from.x_m;
    return motion * covariance * motion.transpose();
}

/// Of the part that fixes had in common, what the next one does not share: directions that it tells
/// nothing of. From one fix to the next of the same kind it changes by less than half.
Eigen::Matrix3d no_more_shared(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> rest(before / 2 - now);
    return 2 * rest.eigenvectors() * rest.eigenvalues().cwiseMax(0).asDiagonal() *
           rest.eigenvectors().transpose();
}

/// What `known` lacks, direction by direction, to know no more than `least`.
Eigen::Matrix3d too_sure(const Eigen::Matrix3d& known, const Eigen::Matrix3d& least) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> rest(least - known);
    return rest.eigenvectors() * rest.eigenvalues().cwiseMax(0).asDiagonal() *
           rest.eigenvectors().transpose();
}

/// A filter that was corrected by what had told it before: it knows as much as the better of both.
localisation::PoseFilter told_once(localisation::PoseFilter corrected,
                                   const Eigen::Matrix3d& before, const Eigen::Matrix3d& fix) {
    const bool is_better = fix(0, 0) + fix(1, 1) < before(0, 0) + before(1, 1);
    corrected.blur(too_sure(corrected.covariance(), is_better ? fix : before));
    return corrected;
}

/// Where one code puts the body, and how well.
std::pair<Pose2, Eigen::Matrix3d> by_code(const localisation::CodeObservation& seen,
                                          const localisation::SurveyedCode& code) {
    const double heading_rad = wrap(code.pose.heading_rad - seen.up_rad);
    const geometry::Point2 arm = Pose2{0, 0, heading_rad} * seen.centre;
    const geometry::Point2 place = code.pose.position() - arm;
    const double place2 = square(seen.sigma_m) + square(code.sigma_m);
    const double angle2 = square(seen.sigma_up_rad) + square(code.sigma_heading_rad);
    const Eigen::Vector3d swing(arm.y_m, -arm.x_m, 1);
    const Eigen::Matrix3d covariance =
        angle2 * swing * swing.transpose() +
        Eigen::Matrix3d(Eigen::Vector3d(place2, place2, 0).asDiagonal());
    return {{place.x_m, place.y_m, heading_rad}, covariance};
}

PoseSource source_of(localisation::Method method) {
    switch (method) {
        case localisation::Method::kIgps:
            return PoseSource::kLight;
        case localisation::Method::kReflectors:
            return PoseSource::kReflectors;
        case localisation::Method::kContours:
            return PoseSource::kContours;
        default:
            return PoseSource::kCodes;
    }
}

}  // namespace

PoseEstimate::PoseEstimate(const Pose2& start, const localisation::OdometryNoise& noise)
    : noise_(noise), filter_(start, told(), noise), driven_(start), now_(start) {}

void PoseEstimate::drive_to(const Pose2& believed) {
    now_ = believed;
    const Pose2 way = inverse(driven_) * believed;
    if (norm(way.position()) < kStep_m && std::abs(way.heading_rad) < kStep_rad) return;
    catch_up();
}

void PoseEstimate::catch_up() {
    const Pose2 way = inverse(driven_) * now_;
    const Pose2 from = filter_.pose();
    filter_.drive(odometry_of(way));
    lasting_ = moved_on(lasting_, from, filter_.pose());
    if (other_) other_->filter.drive(odometry_of(way));
    since_m_ += norm(way.position());
    driven_ = now_;
}

/// Before anything has told where it is, there is no pose to move.
Pose2 PoseEstimate::off_of(const Pose2& pose) const {
    return begun_ > 0 ? inverse(filter_.pose()) * pose : Pose2{};
}

/// The first time there is nothing to believe it against.
void PoseEstimate::note_begun(PoseSource by, const std::string& what, const Pose2& off) {
    if (begun_ == 0) {
        fixes_.took(by, what, off);
    } else {
        fixes_.began_anew(by, what, off);
    }
    ++begun_;
}

void PoseEstimate::note(PoseSource source) {
    source_ = source;
    since_m_ = 0;
    by_codes_ += source == PoseSource::kStop || source == PoseSource::kCodes;
}

double PoseEstimate::driven_since_m() const {
    return since_m_ + norm((inverse(driven_) * now_).position());
}

void PoseEstimate::rest(double speed_share) {
    catch_up();
    filter_.rest(speed_share);
    if (other_) other_->filter.rest(speed_share);
}

/// Codes do not share what beacons have in common: against them all of it counts.
localisation::PoseFilter PoseEstimate::against_codes() const {
    localisation::PoseFilter filter = filter_;
    filter.blur(lasting_);
    return filter;
}

void PoseEstimate::take(const localisation::PoseFix& fix) {
    catch_up();
    filter_ = against_codes();
    lasting_.setZero();
    other_.reset();
    const Pose2 off = off_of(fix.pose);
    const Eigen::Matrix3d before = filter_.covariance();
    if (filter_.correct(fix)) {
        fixes_.took(PoseSource::kStop, {}, off);
        if (told_again(fix.payloads)) {
            filter_ = told_once(filter_, before, localisation::matrix(fix.covariance));
        }
    } else {
        filter_.restart(fix.pose, localisation::matrix(fix.covariance));
        note_begun(PoseSource::kStop, {}, off);
    }
    told_by_ = fix.payloads;
    driven_ = now_ = fix.pose;
    note(PoseSource::kStop);
}

Status PoseEstimate::see(const localisation::CodeObservation& seen,
                         const localisation::SurveyedCode& code) {
    catch_up();
    const auto [by_it, its] = by_code(seen, code);
    const Pose2 off = off_of(by_it);
    if (other_ && other_->doubted && other_->by == code.payload) {
        fixes_.refused(PoseSource::kCodes, code.payload, "innovation_gate", off);
        return fail(Errc::kConflict, "innovation_gate",
                    "The code was half believed already; the same one again is no other witness.");
    }
    localisation::PoseFilter filter = against_codes();
    const Eigen::Matrix3d before = filter.covariance();
    const Status corrected = filter.correct(seen, code);
    if (corrected) {
        fixes_.took(PoseSource::kCodes, code.payload, off_of(filter.pose()));
        const bool again = told_again(std::span(&code.payload, 1));
        filter_ = again ? told_once(filter, before, its) : filter;
    } else if (begins_by(seen, code)) {
        note_begun(PoseSource::kCodes, code.payload, off);
    } else {
        fixes_.refused(PoseSource::kCodes, code.payload, corrected.error().reason.code, off);
        return corrected;
    }
    told_by_ = {code.payload};
    other_.reset();
    lasting_.setZero();
    note(PoseSource::kCodes);
    return {};
}

/// A right code that is refused and no more would be the last one: the error that it has shown
/// grows until the next one lies outside the view. Codes that are moved lie farther off.
bool PoseEstimate::doubt(const localisation::CodeObservation& seen,
                         const localisation::SurveyedCode& code) {
    localisation::PoseFilter by_it = against_codes();
    by_it.blur((square(kDoubtSigmas) - 1) * by_it.covariance());
    if (!by_it.correct(seen, code)) return false;
    filter_.average(by_it);
    return true;
}

/// Two codes were moved alike less often than wheels slip.
bool PoseEstimate::begins_by(const localisation::CodeObservation& seen,
                             const localisation::SurveyedCode& code) {
    if (other_ && other_->by != code.payload && other_->filter.correct(seen, code)) {
        filter_ = other_->filter;
        return true;
    }
    const auto [pose, covariance] = by_code(seen, code);
    other_ = Other{filter_, code.payload, doubt(seen, code)};
    other_->filter.restart(pose, covariance);
    return false;
}

/// By codes, and not so long ago that beacons, however often they are seen, would know it better.
bool PoseEstimate::knows_better_than(const Eigen::Matrix3d& lasting) const {
    if (!lasting_.isZero()) return false;
    const Eigen::Matrix3d known = filter_.covariance();
    return known(0, 0) + known(1, 1) < lasting(0, 0) + lasting(1, 1) && known(2, 2) < lasting(2, 2);
}

bool PoseEstimate::told_again(std::span<const std::string> by) const {
    return std::ranges::any_of(by, [&](const std::string& one) {
        return std::ranges::find(told_by_, one) != told_by_.end();
    });
}

Status PoseEstimate::see(const localisation::BeaconFix& seen, const Eigen::Matrix3d& since) {
    catch_up();
    const Eigen::Matrix3d lasting = localisation::matrix(seen.lasting);
    localisation::PoseFilter filter = filter_;
    filter.blur(no_more_shared(lasting_, lasting));
    const Status corrected = filter.correct(seen.fix, lasting);
    if (!corrected || knows_better_than(lasting)) {
        note_unused(seen, corrected);
        return corrected;
    }
    fixes_.took(source_of(seen.fix.method), {}, off_of(filter.pose()));
    filter_ = filter;
    lasting_ = lasting;
    filter_.blur(since);
    note(source_of(seen.fix.method));
    return {};
}

Status PoseEstimate::check(const localisation::BeaconFix& seen) {
    catch_up();
    localisation::PoseFilter filter = filter_;
    const Status agrees = filter.correct(seen.fix, localisation::matrix(seen.lasting));
    note_unused(seen, agrees);
    return agrees;
}

void PoseEstimate::note_unused(const localisation::BeaconFix& seen, const Status& agrees) {
    const PoseSource by = source_of(seen.fix.method);
    const Pose2 off = off_of(seen.fix.pose);
    if (agrees) {
        fixes_.agreed(by, off);
    } else {
        fixes_.refused(by, {}, agrees.error().reason.code, off);
    }
}

void PoseEstimate::restart_at(const localisation::BeaconFix& seen) {
    catch_up();
    note_begun(source_of(seen.fix.method), {}, off_of(seen.fix.pose));
    lasting_ = localisation::matrix(seen.lasting);
    filter_.restart(seen.fix.pose, localisation::matrix(seen.fix.covariance) - lasting_);
    told_by_.clear();
    other_.reset();
    note(source_of(seen.fix.method));
}

void PoseEstimate::led_to(const Pose2& believed) {
    driven_ = believed * (inverse(now_) * driven_);
    now_ = believed;
}

void PoseEstimate::start_at(const Pose2& pose, double sigma_xy_m, double sigma_heading_rad,
                            PoseSource by) {
    const bool is_said = sigma_xy_m > 0 && sigma_heading_rad > 0;
    catch_up();
    fixes_.took(by, {}, off_of(pose));
    filter_.restart(pose, is_said ? known_to(sigma_xy_m, sigma_heading_rad) : told());
    ++begun_;
    lasting_.setZero();
    told_by_.clear();
    other_.reset();
    driven_ = now_ = pose;
    note(by);
}

/// With the way that the filter has not followed yet.
Eigen::Matrix3d PoseEstimate::covariance() const {
    localisation::PoseFilter now = filter_;
    now.drive(odometry_of(inverse(driven_) * now_));
    return now.covariance() + moved_on(lasting_, filter_.pose(), now.pose());
}

double PoseEstimate::sigma_xy_m() const { return localisation::worse_axis_m(covariance()); }

double PoseEstimate::sigma_heading_rad() const {
    return std::sqrt(std::max(0.0, covariance()(2, 2)));
}

double PoseEstimate::score() const {
    return localisation::localization_score(sigma_xy_m(), sigma_heading_rad(), kTolerance_m,
                                            kTolerance_rad);
}

}  // namespace pulseline::onboard
