#include "core/simulation/world/floor_height.hpp"

#include <cmath>

namespace pulseline::simulation {
namespace {

constexpr double kWave_m = 0.001;  // of each direction
constexpr double kAcross_radpm = 0.9;
constexpr double kAlong_radpm = 0.7;

}  // namespace

std::optional<double> usual_floor_height(geometry::Point2 hall) {
    return kWave_m * (std::sin(kAcross_radpm * hall.x_m) + std::sin(kAlong_radpm * hall.y_m + 1));
}

}  // namespace pulseline::simulation
