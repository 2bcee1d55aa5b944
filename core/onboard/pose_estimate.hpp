#pragma once

#include "core/localisation/pose_filter.hpp"

namespace pulseline::onboard {

/// How well the vehicle knows where it stands: its odometry and its measured stops, fused. Sigmas
/// and score go into the state message.
class PoseEstimate {
public:
    explicit PoseEstimate(const geometry::Pose2& start);

    /// The wheels say that it drove on to here.
    void drive_to(const geometry::Pose2& believed);
    /// A stop was measured. One that contradicts the way driven is taken all the same, for it was
    /// seen, but as a new beginning: the vehicle was moved by hand, or its wheels slipped.
    void take(const localisation::PoseFix& fix);
    /// A person said where it stands.
    void start_at(const geometry::Pose2& pose);

    double sigma_xy_m() const { return filter_.sigma_xy_m(); }
    double sigma_heading_rad() const { return filter_.sigma_heading_rad(); }
    /// VDA 5050 localizationScore, against the tolerance of a usual station.
    double score() const;

private:
    localisation::PoseFilter filter_;
    geometry::Pose2 driven_;  // as far as the filter has followed
};

}  // namespace pulseline::onboard
