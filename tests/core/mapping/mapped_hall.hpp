#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "core/mapping/map_builder.hpp"
#include "core/mapping/monte_carlo.hpp"
#include "core/simulation/world/scanners.hpp"
#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::mapping::testing {

using geometry::Pose2;

/// A hall of 30 m x 16 m with jigs of unlike shapes.
inline plant::Plant hall_with_jigs() {
    plant::Plant plant;
    plant::Hall hall;
    hall.id = plant::HallId("hall");
    hall.outline = {{-6, -8}, {24, -8}, {24, 8}, {-6, 8}};
    plant.halls = {hall};
    const std::vector<geometry::Polygon> jigs = {{{2, 3}, {5, 3}, {5, 4.2}, {2, 4.2}},
                                                 {{9, -5.5}, {10.5, -5.5}, {10.5, -3}, {9, -3}},
                                                 {{14, 3.5}, {15, 3}, {17, 4.5}, {16, 5.5}},
                                                 {{-3, -4.5}, {0, -5.5}, {0.5, -4.5}},
                                                 {{19.5, -4}, {21, -4}, {21, -2.5}, {19.5, -2.5}}};
    for (const auto& outline : jigs) {
        plant::Area jig;
        jig.id = plant::AreaId("jig-" + std::to_string(plant.areas.size() + 1));
        jig.hall = hall.id;
        jig.kind = plant::AreaKind::kObstacle;
        jig.outline = outline;
        plant.areas.push_back(jig);
    }
    return plant;
}

inline Eigen::Matrix3d sigmas(double place_m, double heading_rad) {
    return Eigen::Vector3d(place_m * place_m, place_m * place_m, heading_rad * heading_rad)
        .asDiagonal();
}

/// The scanners of a vehicle that is put where it shall stand.
class Scanning {
public:
    explicit Scanning(std::uint64_t seed, plant::Plant plant = hall_with_jigs(),
                      const plant::VehicleType& type = pulseline::testing::mecanum())
        : world(simulation::make_world(std::move(plant), seed)),
          scanners(world, plant::HallId("hall"), type, pose, seed) {}

    const std::vector<control::Scan>& from(const Pose2& place) {
        pose = place;
        scanners.scan(scans);
        return scans;
    }

    simulation::World world;
    Pose2 pose;
    simulation::SimulatedScanners scanners;
    std::vector<control::Scan> scans;
};

/// As a vehicle maps it that drives to and fro and knows at both ends where it stands.
inline OccupancyMap mapped() {
    Scanning scanning(7);
    MapBuilder builder(Pose2{});
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    Pose2 at;
    builder.take({}, sigmas(1e-4, 1e-4), scanning.from(at));
    for (const double step_m : {0.3, -0.3}) {
        for (int i = 0; i < 60; ++i) {
            const Pose2 moved{step_m, 0, 0};
            const Pose2 told{step_m + 5e-4 * normal(random), 5e-4 * normal(random),
                             2e-4 * normal(random)};
            at = at * moved;
            builder.take(told, sigmas(5e-4, 2e-4), scanning.from(at));
        }
        builder.stands_at(at, sigmas(1e-3, 3e-4));
    }
    return builder.map();
}

}  // namespace pulseline::mapping::testing
