#pragma once

#include <cstdint>
#include <vector>

#include "core/planning/legs/leg_planner.hpp"

namespace pulseline::bench {

/// The hall of the manoeuvre bench: 120 m x 60 m with two aircraft-shaped obstacles and parked
/// platforms, and the 10.5 m x 2.5 m platform that is to find its way, turning radius 5 m, which
/// may not turn on the spot (the harder case, and the one that Reeds-Shepp planners solve).
struct ManoeuvreScene {
    plant::Plant plant;
    std::vector<planning::StandingBody> parked;

    ManoeuvreScene();
    const plant::Hall& hall() const { return plant.halls.front(); }
    const plant::VehicleType& platform() const { return plant.vehicle_types.front(); }
    /// By the exact test: the platform keeps its clearance there.
    bool is_free(const geometry::Pose2& pose) const;
};

struct ManoeuvreQuery {
    geometry::Pose2 start;
    geometry::Pose2 goal;
    double best_m = 0;  // shortest known path; 0: none known
    bool near = false;  // start and goal within 3 m to 20 m, else more than 40 m apart
};

/// Draws a start and a goal, both free. `near` as in ManoeuvreQuery.
ManoeuvreQuery draw_query(const ManoeuvreScene& scene, bool near, std::uint64_t seed);

}  // namespace pulseline::bench
