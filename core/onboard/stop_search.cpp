#include "core/onboard/stop_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/control/manoeuvre.hpp"
#include "core/localisation/codes_on_way.hpp"

namespace pulseline::onboard {
namespace {

// Moves end a little off, and the reach holds for where they end.
constexpr double kOfReach = 0.9;

/// Least radius round a camera's foot in which it sees each code of the stop whole.
double view_radius_m(const plant::VehicleType& type, const vda5050::StopTarget& target) {
    double size_m = 0;
    for (const auto& marker : target.markers) size_m = std::max(size_m, marker.size_m);
    if (size_m == 0) return 0;
    double radius_m = 0;
    for (const auto& camera : type.cameras) {
        const double seen_m = localisation::view_radius_m(camera, size_m);
        radius_m = radius_m == 0 ? seen_m : std::min(radius_m, seen_m);
    }
    return radius_m;
}

}  // namespace

std::vector<Pose2> search_places(const plant::VehicleType& type, const vda5050::StopTarget& target,
                                 double reach_m) {
    const double radius_m = view_radius_m(type, target);
    if (radius_m <= 0) return {};
    // Circles whose middles lie on a square grid of this pitch cover the floor.
    const double pitch_m = std::min(std::sqrt(2) * radius_m, kOfReach * reach_m / std::sqrt(2));
    using Steps = std::vector<std::pair<int, int>>;  // ahead, to the left; none is a long move
    const Steps steps = control::moves_sideways(type) ? Steps{{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                                              {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}
                                                      : Steps{{1, 0}, {0, 0}, {-1, 0}};
    std::vector<Pose2> places;
    for (const auto& [ahead, left] : steps) {
        places.push_back(target.target * Pose2{ahead * pitch_m, left * pitch_m, 0});
    }
    places.push_back(target.target);
    return places;
}

}  // namespace pulseline::onboard
