#include "core/fleet/tables/plant_tables.hpp"

#include <utility>

#include "core/fleet/tables/floor_graph.hpp"

namespace pulseline::fleet {

std::shared_ptr<const PlantTables> plant_tables(const plant::Plant& plant) {
    auto tables = std::make_shared<PlantTables>(plant);
    for (const auto& [type, loaded, vehicles] : classes_of(plant)) {
        FloorClass made = floor_class(plant, tables->planner, tables->overhead, *type, loaded);
        made.graph = tables->empty_floor.add_graph(move_graph(plant, tables->overhead, made));
        tables->classes.push_back(std::move(made));
    }
    return tables;
}

}  // namespace pulseline::fleet
