#pragma once

#include "core/localisation/pose_filter.hpp"

namespace pulseline::onboard {

/// How well the vehicle knows where it stands: its odometry and its measured stops, fused. Sigmas
/// and score go into the state message.
class PoseEstimate {
public:
    explicit PoseEstimate(const geometry::Pose2& start,
                          const localisation::OdometryNoise& noise = {});

    /// The wheels say that it drove on to here.
    void drive_to(const geometry::Pose2& believed);
    /// It has come to rest from this share of its full speed.
    void rest(double speed_share);
    /// A code seen under way, from where the vehicle is now. Fails with innovation_gate, and leaves
    /// the pose alone, when it contradicts the way driven.
    Status see(const localisation::CodeObservation& seen, const localisation::SurveyedCode& code);
    /// Without a motion, the drive believes to be here from now on.
    void led_to(const geometry::Pose2& believed);
    /// A stop was measured. One that contradicts the way driven is taken all the same, for it was
    /// seen, but as a new beginning: the vehicle was moved by hand, or its wheels slipped.
    void take(const localisation::PoseFix& fix);
    /// A person said where it stands.
    void start_at(const geometry::Pose2& pose);

    /// Where it is now; the drive may believe something else until it was led there.
    geometry::Pose2 pose() const { return filter_.pose() * (inverse(driven_) * now_); }
    /// Of x_m, y_m, heading_rad in the hall frame.
    Eigen::Matrix3d covariance() const { return filter_.covariance(); }
    double sigma_xy_m() const { return filter_.sigma_xy_m(); }
    double sigma_heading_rad() const { return filter_.sigma_heading_rad(); }
    /// VDA 5050 localizationScore, against the tolerance of a usual station.
    double score() const;

private:
    void catch_up();

    localisation::PoseFilter filter_;
    geometry::Pose2 driven_;  // by the drive's belief, as far as the filter has followed
    geometry::Pose2 now_;     // by the drive's belief
};

}  // namespace pulseline::onboard
