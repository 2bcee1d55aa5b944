#include "core/simulation/world/supports.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/simulation/world/world.hpp"

namespace pulseline::simulation {
namespace {

// Farther off, a vehicle is not below it.
constexpr double kBelow_m = 0.25;
constexpr double kBelow_rad = 2 * kPi / 180;
constexpr double kWeighed_share = 0.005;

}  // namespace

Supports::Supports(const plant::Plant& plant, std::uint64_t seed) {
    for (const auto& station : plant.stations) {
        if (!station.support) continue;
        Place place{station.hall, station.pose, station.support->height_m, {}};
        for (const auto& load : plant.loads) {
            if (load.station == station.id) place.load = true_load(load, seed);
        }
        places_.push_back(std::move(place));
    }
}

Supports::Place* Supports::above(const plant::HallId& hall, const geometry::Pose2& true_pose) {
    const auto found = std::ranges::find_if(places_, [&](const Place& place) {
        return place.hall == hall &&
               geometry::distance(place.pose.position(), true_pose.position()) <= kBelow_m &&
               std::abs(wrap(place.pose.heading_rad - true_pose.heading_rad)) <= kBelow_rad;
    });
    return found == places_.end() ? nullptr : &*found;
}

TrueLoad true_load(const plant::Load& load, std::uint64_t seed) {
    std::mt19937_64 random(seed_for(seed, "load " + load.id.str()));
    std::uniform_real_distribution<double> share(-1, 1);
    return {load.id, load.mass_kg * (1 + kWeighed_share * share(random)), load.centre};
}

}  // namespace pulseline::simulation
