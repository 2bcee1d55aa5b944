#pragma once

#include <memory>
#include <vector>

#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/tables/overhead.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/plant/plant.hpp"
#include "core/traffic/traffic.hpp"

/// What the fleet works out of the plant alone. It costs more than all the rest of a start, so a
/// fleet that is built anew in the same process takes over the tables of the one before.
namespace pulseline::fleet {

struct PlantTables {
    explicit PlantTables(const plant::Plant& plant)
        : planner(plant), lanes(plant), overhead(overhead_of(plant)) {}

    planning::LegPlanner planner;
    planning::LaneLines lanes;
    traffic::TileSet overhead;           // where loads may stand, above the floor
    std::vector<FloorClass> classes;     // of all vehicles; classes[i].graph is i
    traffic::Traffic empty_floor{true};  // the classes' graphs without a vehicle; for the monitor
};

/// REQUIRES: the plant outlives the tables unchanged. Read-only, so shared without a lock.
std::shared_ptr<const PlantTables> plant_tables(const plant::Plant& plant);

}  // namespace pulseline::fleet
