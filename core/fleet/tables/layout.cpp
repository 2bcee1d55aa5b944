#include "core/fleet/tables/layout.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/fleet/tables/code_gaps.hpp"
#include "core/fleet/tables/code_speeds.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/tables/light_gaps.hpp"
#include "core/traffic/layout_check.hpp"

namespace pulseline::fleet {

std::vector<Reason> check_layout(const plant::Plant& plant) {
    const planning::LegPlanner planner(plant);
    std::vector<FloorClass> classes;
    std::vector<std::size_t> vehicles;
    for (const auto& vehicle : plant.vehicles) {
        const auto* type = plant::find_vehicle_type(plant, vehicle.type);
        if (!type) continue;  // validate() says so
        const auto known = std::find_if(classes.begin(), classes.end(), [&](const auto& c) {
            return c.type == type && c.loaded == is_loaded(vehicle);
        });
        if (known != classes.end()) {
            ++vehicles[static_cast<std::size_t>(known - classes.begin())];
            continue;
        }
        classes.push_back(floor_class(plant, planner, *type, is_loaded(vehicle)));
        vehicles.push_back(1);
    }
    std::vector<traffic::MoveGraph> graphs;
    for (const auto& of_class : classes) graphs.push_back(move_graph(plant, of_class));
    std::vector<traffic::LayoutClass> layout;
    for (std::size_t c = 0; c < classes.size(); ++c) {
        traffic::LayoutClass entry;
        entry.name = classes[c].type->id.str() + (classes[c].loaded ? " with load" : "");
        entry.graph = &graphs[c];
        entry.vehicles = vehicles[c];
        for (std::size_t p = 0; p < classes[c].motion.places.size(); ++p) {
            const auto& station = classes[c].motion.places[p].station;
            if (!station.empty()) entry.goals.push_back(static_cast<traffic::PlaceIndex>(p));
            entry.place_names.push_back(station.str());
        }
        layout.push_back(std::move(entry));
    }
    std::vector<Reason> reasons;
    for (auto& violation : traffic::check_layout(layout)) {
        reasons.push_back(std::move(violation.reason));
    }
    std::ranges::move(check_codes(plant, classes), std::back_inserter(reasons));
    std::ranges::move(check_code_speeds(plant, classes), std::back_inserter(reasons));
    std::ranges::move(check_light(plant, classes), std::back_inserter(reasons));
    return reasons;
}

}  // namespace pulseline::fleet
