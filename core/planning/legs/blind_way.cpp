#include "core/planning/legs/blind_way.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/primitives.hpp"
#include "core/localisation/codes_on_way.hpp"

namespace pulseline::planning {
namespace {

constexpr double kLookEvery_m = 0.5;

/// A stretch of the leg's way on which it finds itself, if it has driven so far at most without.
struct Sight {
    double from_m = 0;
    double to_m = 0;
    double at_most_m = 0;
};

void add_codes(const LegTask& task, const kinematics::Segment& segment, double before_m,
               std::vector<Sight>& sights) {
    const double length_m = std::abs(segment.length_m);
    for (const auto& marker : task.plant.markers) {
        if (marker.hall != task.request.hall) continue;
        const auto shares = localisation::seen_at(marker, task.reach.cameras(), segment);
        if (shares.empty()) continue;
        sights.push_back({before_m + shares.front() * length_m, before_m + shares.back() * length_m,
                          task.reach.at_most_m(marker.size_m)});
    }
}

bool has_beacons(const LegTask& task) {
    return task.reach.has_beacons() &&
           !(task.plant.transmitters.empty() && task.plant.reflectors.empty());
}

void add_beacons(const LegTask& task, const kinematics::Segment& segment, double before_m,
                 std::vector<Sight>& sights) {
    const double length_m = std::abs(segment.length_m);
    const int looks = 1 + static_cast<int>(std::ceil(length_m / kLookEvery_m));
    for (int i = 0; i <= looks; ++i) {
        const double share = static_cast<double>(i) / looks;
        const auto at = kinematics::pose_at(segment, share).position();
        if (!task.reach.is_lit(task.plant, task.request.hall, at)) continue;
        const double way_m = before_m + share * length_m;
        sights.push_back({way_m, way_m, task.reach.in_the_dark_m()});
    }
}

std::vector<Sight> sights_along(const LegTask& task,
                                const std::vector<kinematics::Segment>& segments) {
    const bool by_beacons = has_beacons(task);
    std::vector<Sight> sights;
    double before_m = 0;
    for (const auto& segment : segments) {
        if (!task.reach.cameras().empty()) add_codes(task, segment, before_m, sights);
        if (by_beacons) add_beacons(task, segment, before_m, sights);
        before_m += std::abs(segment.length_m);
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

/// What it finds itself by at the end: the station's codes, or light.
double at_end_m(const LegTask& task) {
    if (const double size_m = size_at(task); size_m > 0 && !task.reach.cameras().empty()) {
        return task.reach.at_most_m(size_m);
    }
    return task.reach.has_beacons() ? task.reach.in_the_dark_m() : 0;
}

}  // namespace

std::vector<TurnAt> turns_on(std::span<const kinematics::Segment> segments) {
    std::vector<TurnAt> turns;
    double before_m = 0;
    for (const auto& segment : segments) {
        const double length_m = std::abs(segment.length_m);
        // Where the way begins it stands already.
        const bool brakes = segment.kind == kinematics::Segment::Kind::kRotate && before_m > 0;
        if (segment.turn_rad != 0) {
            turns.push_back({before_m + length_m / 2, segment.turn_rad, brakes});
        }
        before_m += length_m;
    }
    return turns;
}

BlindWay blind_way(const LegTask& task, const std::vector<kinematics::Segment>& segments) {
    const bool by_codes = !task.reach.cameras().empty() && !task.plant.markers.empty();
    const bool by_beacons = has_beacons(task);
    if (!by_codes && !by_beacons) return {};
    auto sights = sights_along(task, segments);
    double length_m = 0;
    for (const auto& segment : segments) length_m += std::abs(segment.length_m);
    if (const double at_most_m = at_end_m(task); at_most_m > 0) {
        sights.push_back({length_m, length_m, at_most_m});
    }
    const auto turns = turns_on(segments);
    BlindWay worst;
    double seen_m = 0;  // way until which it found itself last
    for (const Sight& sight : sights) {
        const double gap_m = sight.from_m - seen_m;
        const double turns_m = task.reach.as_straight_m(seen_m, sight.from_m, turns) - gap_m;
        const BlindWay gap{gap_m, sight.at_most_m - turns_m};
        if (gap.way_m - gap.at_most_m > worst.way_m - worst.at_most_m) worst = gap;
        seen_m = std::max(seen_m, sight.to_m);
    }
    return worst;
}

}  // namespace pulseline::planning
