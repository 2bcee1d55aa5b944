#include "core/fleet/tables/plant_tables.hpp"

#include <algorithm>
#include <utility>

#include "core/fleet/tables/floor_graph.hpp"

namespace pulseline::fleet {

std::shared_ptr<const PlantTables> plant_tables(const plant::Plant& plant) {
    auto tables = std::make_shared<PlantTables>(plant);
    for (const auto& vehicle : plant.vehicles) {
        const auto* type = plant::find_vehicle_type(plant, vehicle.type);
        if (!type) continue;  // validate() refuses such a plant
        const bool loaded = is_loaded(vehicle);
        const bool known =
            std::any_of(tables->classes.begin(), tables->classes.end(),
                        [&](const auto& c) { return c.type == type && c.loaded == loaded; });
        if (known) continue;
        FloorClass made = floor_class(plant, tables->planner, *type, loaded);
        made.graph = tables->empty_floor.add_graph(move_graph(plant, made));
        tables->classes.push_back(std::move(made));
    }
    return tables;
}

}  // namespace pulseline::fleet
