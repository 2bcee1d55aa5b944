#pragma once

#include <Eigen/Core>

#include "core/base/result.hpp"
#include "core/localisation/dual_camera.hpp"

namespace pulseline::localisation {

/// Motion since the last step as the wheels tell it, body frame (x forward, y to the left).
struct Odometry {
    double forward_m = 0;
    double left_m = 0;
    double turn_rad = 0;  // counter-clockwise
};

/// Growth of the odometry's error, one sigma, as random walks: what a step adds does not depend on
/// how the way is cut into steps. About twice what a machine as it comes from assembly does
/// (DriveErrors), its constant errors over some ten metres among it, so that one that nobody has
/// looked after is covered, too.
struct OdometryNoise {
    double sigma_m_per_sqrt_m = 1.5e-3;  // along and across, each
    double sigma_rad_per_sqrt_m = 2.5e-4;
    double sigma_rad_per_sqrt_rad = 1e-3;
};

/// Extended Kalman filter over (x_m, y_m, heading_rad) in the hall frame. Odometry moves it, codes
/// correct it; a code that contradicts it by more than chance allows is refused and leaves the pose
/// alone. The heading is small-error linearised, wrapped after each step.
class PoseFilter {
public:
    PoseFilter(const Pose2& start, const Eigen::Matrix3d& covariance)
        : pose_(start), covariance_(covariance) {}

    void drive(const Odometry& odometry, const OdometryNoise& noise = {});

    /// A whole pose, from localisation::locate. Fails with innovation_gate {chi2, limit}.
    Status correct(const PoseFix& fix);
    /// One code in view: its place and angle in the body frame against the survey. Fails with
    /// innovation_gate {chi2, limit}.
    Status correct(const CodeObservation& seen, const SurveyedCode& code);

    const Pose2& pose() const { return pose_; }
    const Eigen::Matrix3d& covariance() const { return covariance_; }
    double sigma_xy_m() const;  // the worse direction
    double sigma_heading_rad() const;

private:
    Status update(const Eigen::Vector3d& innovation, const Eigen::Matrix3d& jacobian,
                  const Eigen::Matrix3d& noise);

    Pose2 pose_;
    Eigen::Matrix3d covariance_;
};

/// VDA 5050 localizationScore: 1 when the pose is much better known than the tolerance asks, 0.5
/// when one sigma is the tolerance, towards 0 when nothing is known. Monotonous in both sigmas.
double localization_score(double sigma_xy_m, double sigma_heading_rad, double tolerance_m,
                          double tolerance_rad);

}  // namespace pulseline::localisation
