#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "api/plant/plant_file.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/tables/layout.hpp"
#include "core/fleet/tables/overhead.hpp"
#include "tests/bench/traffic_world.hpp"

// The vehicles of a plant file on the floor that the fleet makes of it.
namespace pulseline::bench {

World plant_world(const std::string& path) {
    const auto plant = api::plant_file::load_plant_file(path);
    if (!plant) {
        std::fprintf(stderr, "%s: %s\n", path.c_str(), plant.error().what.c_str());
        std::exit(2);
    }
    World world;
    world.name = plant->id;
    world.step_s = 1;
    world.dwell_s = 60;
    world.retry_s = 1;
    world.real_plant = true;
    world.well_formed = fleet::check_layout(*plant).empty();
    const planning::LegPlanner planner(*plant);
    const auto overhead = fleet::overhead_of(*plant);
    std::vector<fleet::FloorClass> classes;
    for (const auto& vehicle : plant->vehicles) {
        const auto* type = plant::find_vehicle_type(*plant, vehicle.type);
        const bool loaded = plant::first_load(*plant, vehicle.id) != nullptr;
        auto known = std::find_if(classes.begin(), classes.end(), [&](const auto& c) {
            return c.type == type && c.loaded == loaded;
        });
        if (known == classes.end()) {
            classes.push_back(fleet::floor_class(*plant, planner, overhead, *type, loaded));
            known = classes.end() - 1;
            world.graphs.push_back(fleet::move_graph(*plant, overhead, *known));
            auto& goals = world.goals.emplace_back();
            for (std::size_t p = 0; p < known->motion.places.size(); ++p) {
                if (known->motion.places[p].station.empty()) continue;
                goals.push_back(static_cast<PlaceIndex>(p));
            }
        }
        const auto start = known->motion.station_place(vehicle.home);
        if (!start) {
            std::fprintf(stderr, "%s: vehicle %s has no home that it can stop at; name a station\n",
                         path.c_str(), vehicle.id.str().c_str());
            std::exit(2);
        }
        const auto of_class = static_cast<std::size_t>(known - classes.begin());
        world.vehicles.push_back(
            {static_cast<GraphIndex>(of_class), static_cast<PlaceIndex>(*start), of_class, loaded});
    }
    return world;
}

}  // namespace pulseline::bench
