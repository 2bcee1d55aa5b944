#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/plant/plant.hpp"
#include "core/simulation/world/supports.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// How high vehicles stand in the way of light and rays.
inline constexpr double kVehiclesStand_m = 1.2;

/// A floor code where it truly lies, which the survey only nearly knows.
struct TrueMarker {
    std::string payload;
    plant::MarkerKind kind = plant::MarkerKind::kQr;
    double size_m = 0;
    plant::HallId hall;
    Pose2 pose;
};

/// Not a reflector, but as bright to a navigation scanner.
struct ShiningThing {
    plant::HallId hall;
    geometry::Point2 position;
};

/// What the simulated hall is like in truth: the plant as drawn, the codes as they lie,
/// transmitters and reflectors as they stand.
struct World {
    plant::Plant plant;
    std::vector<TrueMarker> markers;
    std::vector<plant::Transmitter> transmitters;  // as they truly stand
    std::vector<plant::Reflector> reflectors;      // so do they
    std::vector<ShiningThing> shining_things;
    std::shared_ptr<Supports> supports;  // what is on them changes as vehicles work
    localisation::ErrorBudget errors;    // of which its machines are drawn, too
};

/// The codes lie where the survey says + an error of its sigma, and are printed with the budget's
/// errors; transmitters and reflectors stand as theirs say. All are drawn from the seed. Every
/// program with the same plant, seed and budget sees the same world.
World make_world(plant::Plant plant, std::uint64_t seed,
                 const localisation::ErrorBudget& errors = localisation::ErrorBudget::nominal());

/// A seed of its own for each thing of a world, from its name.
std::uint64_t seed_for(std::uint64_t seed, const std::string& name);

/// Where a vehicle's machine truly stands when the world begins: at home, placed by people to
/// within 8 mm and 0.1 deg, so that both cameras see their codes. Error: not_found without a home
/// station.
Result<Pose2> placed_pose(const World& world, const plant::Vehicle& vehicle, std::uint64_t seed);

}  // namespace pulseline::simulation
