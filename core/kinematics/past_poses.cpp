#include "core/kinematics/past_poses.hpp"

namespace pulseline::kinematics {

using geometry::Pose2;

void PastPoses::add(const Pose2& pose, double passed_s, double kept_s) {
    for (Past& past : past_) past.age_s += passed_s;
    past_.push_front({0, pose});
    // The last one that is older than that is what the way between began at.
    while (past_.size() > 1 && past_[past_.size() - 2].age_s > kept_s) past_.pop_back();
}

Pose2 part_way(const Pose2& from, const Pose2& to, double share) {
    const Pose2 step = inverse(from) * to;
    return from * Pose2{share * step.x_m, share * step.y_m, share * step.heading_rad};
}

Pose2 PastPoses::at(double age_s) const {
    for (std::size_t i = 1; i < past_.size(); ++i) {
        if (past_[i].age_s < age_s) continue;
        const double span_s = past_[i].age_s - past_[i - 1].age_s;
        const double share = span_s > 0 ? (age_s - past_[i - 1].age_s) / span_s : 0;
        return part_way(past_[i - 1].pose, past_[i].pose, share);
    }
    return past_.back().pose;
}

}  // namespace pulseline::kinematics
