#include "core/fleet/tables/light_gaps.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "core/localisation/igps_pose.hpp"

namespace pulseline::fleet {
namespace {

constexpr double kLookEvery_m = 1;

std::optional<Reason> light_gap_of(const plant::Plant& plant, const FloorClass& of_class) {
    const plant::VehicleType& type = *of_class.type;
    if (type.receivers.empty() || !type.cameras.empty()) return std::nullopt;
    std::optional<Reason> first;
    std::int64_t count = 0;
    for (const auto& way : of_class.motion.ways) {
        const auto& hall = of_class.motion.places[way.from].hall;
        const int looks =
            1 + static_cast<int>(std::ceil(std::abs(way.segment.length_m) / kLookEvery_m));
        for (int i = 0; i <= looks; ++i) {
            const Pose2 pose = kinematics::pose_at(way.segment, static_cast<double>(i) / looks);
            const auto fix = localisation::expected_fix(plant, hall, type, pose);
            if (fix) continue;
            ++count;
            if (first) continue;
            first = Reason{kLightGap,
                           {{"class", type.id.str()},
                            {"at_x_m", pose.x_m},
                            {"at_y_m", pose.y_m},
                            {"why", fix.error().what}}};
        }
    }
    if (first) first->params.push_back({"count", count});
    return first;
}

}  // namespace

std::vector<Reason> check_light(const plant::Plant& plant, const std::vector<FloorClass>& classes) {
    std::vector<Reason> reasons;
    for (const auto& of_class : classes) {
        if (auto reason = light_gap_of(plant, of_class)) reasons.push_back(std::move(*reason));
    }
    return reasons;
}

}  // namespace pulseline::fleet
