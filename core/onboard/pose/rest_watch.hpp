#pragma once

#include <cstddef>

#include "core/onboard/drive.hpp"
#include "core/onboard/pose/pose_estimate.hpp"

namespace pulseline::onboard {

/// Tells the estimate of each time that the brakes fell in: the chassis settles then, the more the
/// faster it was. A rest between two segments is shorter than a step and is counted by the drive.
/// Thread safety: none.
class RestWatch {
public:
    RestWatch(const Drive& drive, PoseEstimate& estimate)
        : drive_(drive), estimate_(estimate), rests_(drive.rests()) {}

    /// After each step of the drive, before the estimate hears of the way of it: what moves on
    /// after a rest moves on from where the chassis has settled.
    void step();

private:
    const Drive& drive_;
    PoseEstimate& estimate_;
    std::size_t rests_;
    double fastest_share_ = 0;  // of its full speed, since it rested last
};

}  // namespace pulseline::onboard
