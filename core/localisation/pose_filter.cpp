#include "core/localisation/pose_filter.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/localisation/covariance.hpp"

namespace pulseline::localisation {
namespace {

// Chi-square of 3 degrees of freedom at 99.999 %.
constexpr double kGate = 25.9;

}  // namespace

PoseFilter::PoseFilter(const Pose2& start, const Eigen::Matrix3d& covariance,
                       const OdometryNoise& noise)
    : noise_(noise), pose_(start) {
    covariance_.topLeftCorner<3, 3>() = covariance;
    covariance_(3, 3) = square(noise_.scale);
    covariance_(4, 4) = square(noise_.crab_rad);
    covariance_(5, 5) = square(noise_.bend_rad_per_m);
}

void PoseFilter::drive(const Odometry& told) {
    const double scale = 1 + constants_[0];
    const double forward_m = scale * told.forward_m - constants_[1] * told.left_m;
    const double left_m = scale * told.left_m + constants_[1] * told.forward_m;
    const double turn_rad = told.turn_rad + constants_[2] * told.forward_m;
    // The chord of an arc points along the heading of half way.
    const double middle = pose_.heading_rad + turn_rad / 2;
    const double c = std::cos(middle);
    const double s = std::sin(middle);
    const double dx = c * forward_m - s * left_m;
    const double dy = s * forward_m + c * left_m;
    StateMatrix f = StateMatrix::Identity();
    f.col(2).head<2>() << -dy, dx;
    f.col(3).head<2>() << c * told.forward_m - s * told.left_m,
        s * told.forward_m + c * told.left_m;
    f.col(4).head<2>() << -c * told.left_m - s * told.forward_m,
        -s * told.left_m + c * told.forward_m;
    // The turn bends the way: half of its error acts on the chord.
    f.col(5).head<3>() << -dy / 2 * told.forward_m, dx / 2 * told.forward_m, told.forward_m;
    Eigen::Matrix<double, 6, 3> g = Eigen::Matrix<double, 6, 3>::Zero();
    g.topRows<3>() << c, -s, -dy / 2, s, c, dx / 2, 0, 0, 1;
    const double way_m = std::hypot(told.forward_m, told.left_m);
    const double aside_m = std::abs(told.left_m);
    const double turned_rad = std::abs(told.turn_rad);
    const Eigen::Vector3d q{
        square(noise_.forward_m_per_sqrt_m) * way_m,
        square(noise_.left_m_per_sqrt_m) * way_m + square(noise_.sideways_m_per_sqrt_m) * aside_m,
        square(noise_.heading_rad_per_sqrt_m) * way_m +
            square(noise_.sideways_rad_per_sqrt_m) * aside_m +
            square(noise_.heading_rad_per_sqrt_rad) * turned_rad};
    covariance_ = f * covariance_ * f.transpose() + g * q.asDiagonal() * g.transpose();
    // Never more than at first.
    const auto forget = [&](int i, double slope, double most) {
        double& variance = covariance_(i, i);
        variance =
            std::max(variance, std::min(square(most), variance + square(slope) * turned_rad));
    };
    forget(3, noise_.slope_scale, noise_.scale);
    forget(4, noise_.slope_crab_rad, noise_.crab_rad);
    pose_ = {pose_.x_m + dx, pose_.y_m + dy, wrap(pose_.heading_rad + turn_rad)};
}

void PoseFilter::rest(double speed_share) {
    const double place2 = square(noise_.fine_m + speed_share * noise_.settle_m);
    const double heading2 = square(noise_.fine_rad + speed_share * noise_.settle_rad);
    covariance_.diagonal().head<3>() += Eigen::Vector3d(place2, place2, heading2);
}

Status PoseFilter::correct(const PoseFix& fix, const Eigen::Matrix3d& lasting) {
    const Eigen::Vector3d innovation{fix.pose.x_m - pose_.x_m, fix.pose.y_m - pose_.y_m,
                                     wrap(fix.pose.heading_rad - pose_.heading_rad)};
    return update(innovation, Observation::Identity(), matrix(fix.covariance) - lasting, lasting);
}

Status PoseFilter::correct(const CodeObservation& seen, const SurveyedCode& code) {
    // Measured: the code's place in the hall as this pose and camera put it, and its angle.
    const Point2 arm = Pose2{0, 0, pose_.heading_rad} * seen.centre;
    const Eigen::Vector3d innovation{code.pose.x_m - pose_.x_m - arm.x_m,
                                     code.pose.y_m - pose_.y_m - arm.y_m,
                                     wrap(code.pose.heading_rad - pose_.heading_rad - seen.up_rad)};
    Observation h = Observation::Identity();
    h(0, 2) = -arm.y_m;
    h(1, 2) = arm.x_m;
    const double place2 = square(seen.sigma_m) + square(code.sigma_m);
    const double angle2 = square(seen.sigma_up_rad) + square(code.sigma_heading_rad);
    return update(innovation, h, Eigen::Vector3d(place2, place2, angle2).asDiagonal());
}

void PoseFilter::average(const PoseFilter& other) {
    State gap;
    gap << other.pose_.x_m - pose_.x_m, other.pose_.y_m - pose_.y_m,
        wrap(other.pose_.heading_rad - pose_.heading_rad), other.constants_ - constants_;
    covariance_ = (covariance_ + other.covariance_) / 2 + gap * gap.transpose() / 4;
    pose_ = {pose_.x_m + gap[0] / 2, pose_.y_m + gap[1] / 2, wrap(pose_.heading_rad + gap[2] / 2)};
    constants_ += gap.tail<3>() / 2;
}

void PoseFilter::restart(const Pose2& pose, const Eigen::Matrix3d& covariance) {
    pose_ = pose;
    covariance_.topRows<3>().setZero();
    covariance_.leftCols<3>().setZero();
    covariance_.topLeftCorner<3, 3>() = covariance;
}

Status PoseFilter::update(const Eigen::Vector3d& innovation, const Observation& jacobian,
                          const Eigen::Matrix3d& noise, const Eigen::Matrix3d& lasting) {
    const Eigen::Matrix3d s = jacobian * covariance_ * jacobian.transpose() + noise;
    const double chi2 = innovation.dot(Eigen::LDLT<Eigen::Matrix3d>(s + lasting).solve(innovation));
    if (!(chi2 <= kGate))
        return fail(Errc::kConflict, "innovation_gate",
                    "The code contradicts the way driven. A code was moved or exchanged, or the "
                    "wheels slip.",
                    {},
                    {{"chi2", chi2},
                     {"limit", kGate},
                     {"x_m", innovation.x()},
                     {"y_m", innovation.y()},
                     {"heading_rad", innovation.z()}});
    const Eigen::LDLT<Eigen::Matrix3d> solver(s);
    const Eigen::Matrix<double, 6, 3> gain = solver.solve(jacobian * covariance_).transpose();
    const State change = gain * innovation;
    // Joseph's form stays symmetric and positive whatever rounding does.
    const StateMatrix rest = StateMatrix::Identity() - gain * jacobian;
    covariance_ = rest * covariance_ * rest.transpose() + gain * noise * gain.transpose();
    pose_ = {pose_.x_m + change[0], pose_.y_m + change[1], wrap(pose_.heading_rad + change[2])};
    constants_ += change.tail<3>();
    return {};
}

double PoseFilter::sigma_xy_m() const { return worse_axis_m(covariance()); }

double PoseFilter::sigma_heading_rad() const { return std::sqrt(std::max(0.0, covariance_(2, 2))); }

double localization_score(double sigma_xy_m, double sigma_heading_rad, double tolerance_m,
                          double tolerance_rad) {
    const double worse = std::max(sigma_xy_m / tolerance_m, sigma_heading_rad / tolerance_rad);
    return 1 / (1 + worse * worse);
}

}  // namespace pulseline::localisation
