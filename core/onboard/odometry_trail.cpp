#include "core/onboard/odometry_trail.hpp"

namespace pulseline::onboard {
namespace {

// No camera and no receiver takes longer.
constexpr double kRemembered_s = 0.5;

}  // namespace

void OdometryTrail::step(double own_s) {
    const Pose2 now = drive_.believed_pose();
    const Pose2 way = inverse(believed_) * now;
    believed_ = now;
    if (drive_.standing()) past_.clear();
    odometry_ = odometry_ * way;
    for (Past& past : past_) past.age_s += own_s;
    past_.push_front({0, odometry_});
    while (past_.back().age_s > kRemembered_s) past_.pop_back();
}

Pose2 OdometryTrail::now_from_then(double age_s) const {
    const auto then = [&] {
        for (std::size_t i = 1; i < past_.size(); ++i) {
            if (past_[i].age_s < age_s) continue;
            const double span_s = past_[i].age_s - past_[i - 1].age_s;
            const double share = span_s > 0 ? (age_s - past_[i - 1].age_s) / span_s : 0;
            const Pose2 step = inverse(past_[i - 1].odometry) * past_[i].odometry;
            return past_[i - 1].odometry *
                   Pose2{share * step.x_m, share * step.y_m, share * step.heading_rad};
        }
        return past_.back().odometry;
    };
    return inverse(odometry_) * then();
}

}  // namespace pulseline::onboard
