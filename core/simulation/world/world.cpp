#include "core/simulation/world/world.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include "core/base/angle.hpp"

namespace pulseline::simulation {
namespace {

constexpr double kPlaced_m = 0.008;
constexpr double kPlaced_rad = 0.1 * kPi / 180;

/// Anywhere on the floor of a hall that has reflectors.
void add_shining_things(const plant::Plant& plant, const plant::Hall& hall, std::uint64_t seed,
                        const localisation::ErrorBudget& errors, World& world) {
    const bool looked_at = std::ranges::any_of(
        plant.reflectors, [&](const plant::Reflector& r) { return r.hall == hall.id; });
    if (!looked_at) return;
    std::mt19937_64 random(seed_for(seed, "shining " + hall.id.str()));
    const auto box = geometry::bounding_box(hall.outline);
    std::uniform_real_distribution<double> x(box.min.x_m, box.max.x_m);
    std::uniform_real_distribution<double> y(box.min.y_m, box.max.y_m);
    for (int left = errors.reflector.shining_things; left > 0;) {
        const geometry::Point2 at{x(random), y(random)};
        if (!geometry::contains(hall.outline, at)) continue;
        world.shining_things.push_back({hall.id, at});
        --left;
    }
}

}  // namespace

std::uint64_t seed_for(std::uint64_t seed, const std::string& name) {
    std::uint64_t hash = 0xcbf29ce484222325u ^ (seed * 0x9e3779b97f4a7c15u);  // FNV-1a
    for (const char c : name) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3u;
    }
    return hash;
}

World make_world(plant::Plant plant, std::uint64_t seed, const localisation::ErrorBudget& errors) {
    World world;
    world.errors = errors;
    for (const auto& marker : plant.markers) {
        std::mt19937_64 random(seed_for(seed, "marker " + marker.id.str()));
        std::normal_distribution<double> normal;
        TrueMarker lying{marker.payload, marker.kind, marker.size_m, marker.hall, marker.pose};
        lying.pose.x_m += marker.sigma_xy_m * normal(random);
        lying.pose.y_m += marker.sigma_xy_m * normal(random);
        lying.pose.heading_rad =
            wrap(lying.pose.heading_rad + marker.sigma_heading_rad * normal(random));
        lying.pose.x_m += errors.marker.print_m * normal(random);
        lying.pose.y_m += errors.marker.print_m * normal(random);
        lying.size_m *= 1 + errors.marker.print_share * normal(random);
        world.markers.push_back(std::move(lying));
    }
    for (const auto& surveyed : plant.transmitters) {
        std::mt19937_64 random(seed_for(seed, "transmitter " + surveyed.id.str()));
        std::normal_distribution<double> normal;
        plant::Transmitter standing = surveyed;
        for (double* place : {&standing.position.x_m, &standing.position.y_m, &standing.z_m}) {
            *place += surveyed.sigma_place_m * normal(random);
        }
        for (double* turn : {&standing.roll_rad, &standing.pitch_rad, &standing.heading_rad}) {
            *turn += surveyed.sigma_turn_rad * normal(random);
        }
        world.transmitters.push_back(std::move(standing));
    }
    for (const auto& surveyed : plant.reflectors) {
        std::mt19937_64 random(seed_for(seed, "reflector " + surveyed.id.str()));
        std::normal_distribution<double> normal(0, surveyed.sigma_m);
        plant::Reflector standing = surveyed;
        standing.position.x_m += normal(random);
        standing.position.y_m += normal(random);
        world.reflectors.push_back(std::move(standing));
    }
    for (const auto& hall : plant.halls) add_shining_things(plant, hall, seed, errors, world);
    world.supports = std::make_shared<Supports>(plant, seed);
    world.plant = std::move(plant);
    return world;
}

Result<Pose2> placed_pose(const World& world, const plant::Vehicle& vehicle, std::uint64_t seed) {
    const plant::Station* home = plant::find_station(world.plant, vehicle.home);
    if (home == nullptr) {
        return fail(Errc::kNotFound, "no_home_station",
                    "vehicle " + vehicle.id.str() + " has no home station in the plant; give one");
    }
    std::mt19937_64 random(seed_for(seed, "placed " + vehicle.id.str()));
    std::uniform_real_distribution<double> share(-1, 1);
    return home->pose *
           Pose2{kPlaced_m * share(random), kPlaced_m * share(random), kPlaced_rad * share(random)};
}

}  // namespace pulseline::simulation
