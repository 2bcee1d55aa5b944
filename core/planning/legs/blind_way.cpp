#include "core/planning/legs/blind_way.hpp"

#include <algorithm>
#include <cmath>

#include "core/localisation/codes_on_way.hpp"

namespace pulseline::planning {
namespace {

/// A code that comes into view after `from_m` of the leg's way and is in view last at `to_m`.
struct Sight {
    double from_m = 0;
    double to_m = 0;
    double size_m = 0;
};

std::vector<Sight> sights_along(const LegTask& task,
                                const std::vector<kinematics::Segment>& segments) {
    std::vector<Sight> sights;
    double before_m = 0;
    for (const auto& segment : segments) {
        const double length_m = std::abs(segment.length_m);
        for (const auto& marker : task.plant.markers) {
            if (marker.hall != task.request.hall) continue;
            const auto shares = localisation::seen_at(marker, task.reach.cameras(), segment);
            if (shares.empty()) continue;
            sights.push_back({before_m + shares.front() * length_m,
                              before_m + shares.back() * length_m, marker.size_m});
        }
        before_m += length_m;
    }
    std::ranges::sort(sights, {}, &Sight::from_m);
    return sights;
}

/// Of the station's codes the largest, which leaves least room in the picture; 0: it has none.
double size_at(const LegTask& task) {
    double size_m = 0;
    for (const auto& id : task.station.markers) {
        const auto* marker = plant::find_marker(task.plant, id);
        if (marker) size_m = std::max(size_m, marker->size_m);
    }
    return size_m;
}

}  // namespace

CodeReach::CodeReach(const plant::VehicleType& type, bool loaded)
    : cameras_(plant::cameras_of(type, loaded)),
      noise_(cameras_.empty() ? localisation::OdometryNoise()
                              : localisation::odometry_noise(localisation::DriveErrors(), type)) {}

double CodeReach::at_most_m(double size_m) const {
    const auto [known, added] = at_most_m_.try_emplace(size_m, 0);
    for (const auto& camera : cameras_) {
        if (!added) break;
        const double camera_m = localisation::blind_way_m(camera, size_m, {}, noise_);
        known->second = std::max(known->second, camera_m);
    }
    return known->second;
}

BlindWay blind_way(const LegTask& task, const std::vector<kinematics::Segment>& segments) {
    if (task.reach.cameras().empty() || task.plant.markers.empty()) return {};
    auto sights = sights_along(task, segments);
    double length_m = 0;
    for (const auto& segment : segments) length_m += std::abs(segment.length_m);
    if (const double size_m = size_at(task); size_m > 0) {
        sights.push_back({length_m, length_m, size_m});
    }
    BlindWay worst;
    double seen_m = 0;  // way until which a code was in view last
    for (const Sight& sight : sights) {
        const BlindWay gap{sight.from_m - seen_m, task.reach.at_most_m(sight.size_m)};
        if (gap.way_m - gap.at_most_m > worst.way_m - worst.at_most_m) worst = gap;
        seen_m = std::max(seen_m, sight.to_m);
    }
    return worst;
}

}  // namespace pulseline::planning
