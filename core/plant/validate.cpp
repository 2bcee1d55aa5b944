#include "core/plant/validate.hpp"

#include "core/plant/validate_parts.hpp"

namespace pulseline::plant {

detail::Index::Index(const Plant& plant) {
    for (const Hall& hall : plant.halls) halls.emplace(hall.id, &hall);
    for (std::size_t i = 0; i < plant.stations.size(); ++i)
        stations.emplace(plant.stations[i].id, i);
    for (const Marker& marker : plant.markers) markers.emplace(marker.id, &marker);
    for (const VehicleType& type : plant.vehicle_types) types.emplace(type.id, &type);
    for (std::size_t i = 0; i < plant.nodes.size(); ++i) nodes.emplace(plant.nodes[i].id, i);
}

std::vector<Fault> validate(const Plant& plant) {
    if (plant.halls.empty()) {
        return {{"/halls", "no_hall", "The plant has no hall.", "Add one with its outline."}};
    }
    const detail::Index index(plant);
    detail::Faults shape_faults;
    detail::check_numbers(plant, shape_faults);
    detail::check_outlines(plant, shape_faults);
    std::vector<Fault> faults = shape_faults.take();
    // Geometry on top of broken numbers would only name the same fault again in other words.
    const bool sound = faults.empty();

    detail::Faults further;
    detail::check_names(plant, index, further);
    if (sound) {
        detail::check_stations(plant, index, further);
        detail::check_igps(plant, index, further);
        detail::check_reflectors(plant, index, further);
        detail::check_loads(plant, index, further);
        detail::check_roadmap(plant, index, further);
    }
    for (Fault& fault : further.take()) faults.push_back(std::move(fault));
    return faults;
}

std::vector<Fault> validate_load(const Plant& plant, const Load& load) {
    detail::Faults faults;
    detail::check_load_numbers(load, "", faults);
    if (!load.outline.empty()) detail::check_outline(load.outline, "/outline", faults);
    detail::check_load_types(load, "", detail::Index(plant), faults);
    return faults.take();
}

}  // namespace pulseline::plant
