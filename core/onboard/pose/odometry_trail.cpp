#include "core/onboard/pose/odometry_trail.hpp"

namespace pulseline::onboard {
void OdometryTrail::step(double own_s) {
    const Pose2 now = drive_.believed_pose();
    const Pose2 way = inverse(believed_) * now;
    believed_ = now;
    if (drive_.standing()) past_.clear();
    odometry_ = odometry_ * way;
    past_.add(odometry_, own_s, kRemembered_s);
}

}  // namespace pulseline::onboard
