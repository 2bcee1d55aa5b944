#include "core/plant/free_floor.hpp"

#include <algorithm>

namespace pulseline::plant {

bool drives_over_free_floor(const VehicleType& type) {
    const auto lists = [&](MotionMode mode) {
        return std::ranges::find(type.motion_modes, mode) != type.motion_modes.end();
    };
    return lists(MotionMode::kFree) && lists(MotionMode::kLinear);
}

}  // namespace pulseline::plant
