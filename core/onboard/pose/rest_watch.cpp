#include "core/onboard/pose/rest_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pulseline::onboard {

void RestWatch::step() {
    const double share =
        std::abs(drive_.velocity_mps()) / drive_.time_factor() / drive_.type().max_speed_mps;
    fastest_share_ = std::min(1.0, std::max(fastest_share_, share));
    for (; rests_ != drive_.rests(); ++rests_) {
        estimate_.rest(std::exchange(fastest_share_, std::min(1.0, share)));
    }
}

}  // namespace pulseline::onboard
