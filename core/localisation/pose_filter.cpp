#include "core/localisation/pose_filter.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pulseline::localisation {
namespace {

// Chi-square of 3 degrees of freedom at 99.9 %: one right code in a thousand is refused.
constexpr double kGate = 16.27;

Eigen::Matrix3d matrix(const std::array<std::array<double, 3>, 3>& rows) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return m;
}

double square(double x) { return x * x; }

}  // namespace

void PoseFilter::drive(const Odometry& odometry, const OdometryNoise& noise) {
    // The chord of an arc points along the heading of half way.
    const double middle = pose_.heading_rad + odometry.turn_rad / 2;
    const double c = std::cos(middle);
    const double s = std::sin(middle);
    const double dx = c * odometry.forward_m - s * odometry.left_m;
    const double dy = s * odometry.forward_m + c * odometry.left_m;
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    f(0, 2) = -dy;
    f(1, 2) = dx;
    // The turn bends the way: half of its error acts on the chord.
    Eigen::Matrix3d g;
    g << c, -s, -dy / 2, s, c, dx / 2, 0, 0, 1;
    const double way = std::hypot(odometry.forward_m, odometry.left_m);
    const double step2 = square(noise.sigma_m_per_sqrt_m) * way;
    const double turn2 = square(noise.sigma_rad_per_sqrt_rad) * std::abs(odometry.turn_rad) +
                         square(noise.sigma_rad_per_sqrt_m) * way;
    const Eigen::Matrix3d q = Eigen::Vector3d(step2, step2, turn2).asDiagonal();
    covariance_ = f * covariance_ * f.transpose() + g * q * g.transpose();
    pose_ = {pose_.x_m + dx, pose_.y_m + dy, wrap(pose_.heading_rad + odometry.turn_rad)};
}

Status PoseFilter::correct(const PoseFix& fix) {
    const Eigen::Vector3d innovation{fix.pose.x_m - pose_.x_m, fix.pose.y_m - pose_.y_m,
                                     wrap(fix.pose.heading_rad - pose_.heading_rad)};
    return update(innovation, Eigen::Matrix3d::Identity(), matrix(fix.covariance));
}

Status PoseFilter::correct(const CodeObservation& seen, const SurveyedCode& code) {
    // Measured: the code's place in the hall as this pose and camera put it, and its angle.
    const Point2 arm = Pose2{0, 0, pose_.heading_rad} * seen.centre;
    const Eigen::Vector3d innovation{code.pose.x_m - pose_.x_m - arm.x_m,
                                     code.pose.y_m - pose_.y_m - arm.y_m,
                                     wrap(code.pose.heading_rad - pose_.heading_rad - seen.up_rad)};
    Eigen::Matrix3d h = Eigen::Matrix3d::Identity();
    h(0, 2) = -arm.y_m;
    h(1, 2) = arm.x_m;
    const double place2 = square(seen.sigma_m) + square(code.sigma_m);
    const double angle2 = square(seen.sigma_up_rad) + square(code.sigma_heading_rad);
    return update(innovation, h, Eigen::Vector3d(place2, place2, angle2).asDiagonal());
}

Status PoseFilter::update(const Eigen::Vector3d& innovation, const Eigen::Matrix3d& jacobian,
                          const Eigen::Matrix3d& noise) {
    const Eigen::Matrix3d s = jacobian * covariance_ * jacobian.transpose() + noise;
    const Eigen::LDLT<Eigen::Matrix3d> solver(s);
    const double chi2 = innovation.dot(solver.solve(innovation));
    if (!(chi2 <= kGate))
        return fail(Errc::kConflict, "innovation_gate",
                    "The code contradicts the way driven. A code was moved or exchanged, or the "
                    "wheels slip.",
                    {}, {{"chi2", chi2}, {"limit", kGate}});
    const Eigen::Matrix3d gain = solver.solve(jacobian * covariance_).transpose();
    const Eigen::Vector3d change = gain * innovation;
    // Joseph's form stays symmetric and positive whatever rounding does.
    const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - gain * jacobian;
    covariance_ = rest * covariance_ * rest.transpose() + gain * noise * gain.transpose();
    pose_ = {pose_.x_m + change[0], pose_.y_m + change[1], wrap(pose_.heading_rad + change[2])};
    return {};
}

double PoseFilter::sigma_xy_m() const {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance_.topLeftCorner<2, 2>());
    return std::sqrt(std::max(0.0, axes.eigenvalues()[1]));
}

double PoseFilter::sigma_heading_rad() const { return std::sqrt(std::max(0.0, covariance_(2, 2))); }

double localization_score(double sigma_xy_m, double sigma_heading_rad, double tolerance_m,
                          double tolerance_rad) {
    const double worse = std::max(sigma_xy_m / tolerance_m, sigma_heading_rad / tolerance_rad);
    return 1 / (1 + worse * worse);
}

}  // namespace pulseline::localisation
