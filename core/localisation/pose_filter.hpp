#pragma once

#include <Eigen/Core>

#include "core/base/result.hpp"
#include "core/localisation/dual_camera.hpp"
#include "core/localisation/odometry_noise.hpp"

namespace pulseline::localisation {

/// Motion since the last step as the wheels tell it, body frame (x forward, y to the left).
struct Odometry {
    double forward_m = 0;
    double left_m = 0;
    double turn_rad = 0;  // counter-clockwise
};

/// Extended Kalman filter over where the vehicle is (x_m, y_m, heading_rad in the hall frame) and
/// what its odometry makes wrong in every step: scale, crab and bend (OdometryNoise). Odometry
/// moves it, codes correct it and, by what they correct, show the constants; a code that
/// contradicts it by more than chance allows is refused and leaves all of it alone. Small-error
/// linearised, the heading wrapped after each step.
class PoseFilter {
public:
    PoseFilter(const Pose2& start, const Eigen::Matrix3d& covariance,
               const OdometryNoise& noise = {});

    void drive(const Odometry& odometry);
    /// It has come to rest from this share of its full speed.
    void rest(double speed_share);
    /// Its pose is less well known by so much.
    void blur(const Eigen::Matrix3d& covariance) {
        covariance_.topLeftCorner<3, 3>() += covariance;
    }

    /// A whole pose, from localisation::locate. `lasting`: the part of its covariance that later
    /// ones share, so that many of them are no better than one; it counts when the fix is checked,
    /// and covariance() leaves it out. Fails with innovation_gate {chi2, limit, x_m, y_m,
    /// heading_rad}: the last three in the hall frame, by what it is off.
    Status correct(const PoseFix& fix, const Eigen::Matrix3d& lasting = Eigen::Matrix3d::Zero());
    /// One code in view: its place and angle in the body frame against the survey. Fails as
    /// the other one.
    Status correct(const CodeObservation& seen, const SurveyedCode& code);
    /// This one or the other is right, nobody knows which: from now on one between them whose
    /// covariance holds both (two Gaussians merged into one by their moments).
    void average(const PoseFilter& other);
    /// It is here, whatever it believed. What it knows of its odometry stays.
    void restart(const Pose2& pose, const Eigen::Matrix3d& covariance);

    const Pose2& pose() const { return pose_; }
    Eigen::Matrix3d covariance() const { return covariance_.topLeftCorner<3, 3>(); }
    double sigma_xy_m() const;  // the worse direction
    double sigma_heading_rad() const;

    /// What it has learned: the motion is (1 + scale) times what the wheels tell, `crab_rad`
    /// farther counter-clockwise, and turns by `bend_rad_per_m` more a metre ahead.
    double scale() const { return constants_[0]; }
    double crab_rad() const { return constants_[1]; }
    double bend_rad_per_m() const { return constants_[2]; }

private:
    using State = Eigen::Matrix<double, 6, 1>;  // as errors: x, y, heading, scale, crab, bend
    using StateMatrix = Eigen::Matrix<double, 6, 6>;
    using Observation = Eigen::Matrix<double, 3, 6>;

    Status update(const Eigen::Vector3d& innovation, const Observation& jacobian,
                  const Eigen::Matrix3d& noise,
                  const Eigen::Matrix3d& lasting = Eigen::Matrix3d::Zero());

    OdometryNoise noise_;
    Pose2 pose_;
    Eigen::Vector3d constants_ = Eigen::Vector3d::Zero();
    StateMatrix covariance_ = StateMatrix::Zero();
};

/// VDA 5050 localizationScore: 1 when the pose is much better known than the tolerance asks, 0.5
/// when one sigma is the tolerance, towards 0 when nothing is known. Monotonous in both sigmas.
double localization_score(double sigma_xy_m, double sigma_heading_rad, double tolerance_m,
                          double tolerance_rad);

}  // namespace pulseline::localisation
