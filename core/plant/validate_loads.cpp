#include <map>

#include "core/plant/carrying.hpp"
#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

void check_place(const Plant& plant, const Load& load, const std::string& element,
                 const Index& index, Faults& faults) {
    if (!load.vehicle.empty() && !load.station.empty()) {
        faults.add(element + "/station", "two_places",
                   quoted(load.name) + " is on a vehicle and at a station.", "Name one of them.");
        return;
    }
    if (!load.station.empty()) {
        const auto* station = look_up(index.stations, load.station);
        if (station == nullptr) {
            faults.add(element + "/station", "unknown_station",
                       "There is no station " + quoted(load.station.str()) + ".",
                       "Correct the name or add it to the plant.");
        } else if (!plant.stations[*station].support) {
            faults.add(element + "/station", "without_support",
                       "At " + quoted(load.station.str()) + " nothing holds a load.",
                       "Give the station a support, or put the load elsewhere.");
        }
    }
    if (load.vehicle.empty()) return;
    const auto* vehicle = find_vehicle(plant, load.vehicle);
    if (vehicle == nullptr) {
        faults.add(element + "/vehicle", "unknown_vehicle",
                   "There is no vehicle " + quoted(load.vehicle.str()) + ".",
                   "Correct the name or add it to the plant.");
        return;
    }
    const auto* type = look_up(index.types, vehicle->type);
    if (type == nullptr) return;  // said there
    const auto why_not = cannot_carry(**type, load);
    if (!why_not) return;
    const bool heavy = why_not->code == "load_too_heavy";
    faults.add(element + (heavy ? "/mass_kg" : "/vehicle"), heavy ? "overloaded" : why_not->code,
               quoted(load.vehicle.str()) + " may not carry " + quoted(load.name) + ".",
               heavy ? "Lower mass_kg or correct max_load_kg of the type."
                     : "Put it elsewhere, or correct its vehicle_types and outline.");
}

}  // namespace

void check_load_types(const Load& load, const std::string& element, const Index& index,
                      Faults& faults) {
    for (std::size_t k = 0; k < load.vehicle_types.size(); ++k) {
        if (index.types.count(load.vehicle_types[k]) != 0) continue;
        faults.add(element + "/vehicle_types/" + std::to_string(k), "unknown_vehicle_type",
                   "There is no vehicle_type " + quoted(load.vehicle_types[k].str()) + ".",
                   "Correct the name or add it to the plant.");
    }
}

void check_loads(const Plant& plant, const Index& index, Faults& faults) {
    std::map<VehicleId, std::size_t> carried;
    std::map<StationId, std::size_t> held;
    const auto alone = [&](auto& taken, const auto& place, std::size_t i, const char* field) {
        if (place.empty()) return;
        const auto [it, is_new] = taken.emplace(place, i);
        if (is_new) return;
        faults.add(at("loads", i, field), "place_taken",
                   at("loads", it->second) + " is there already.", "Give each its own place.");
    };
    for (std::size_t i = 0; i < plant.loads.size(); ++i) {
        const Load& load = plant.loads[i];
        check_load_types(load, at("loads", i), index, faults);
        check_place(plant, load, at("loads", i), index, faults);
        alone(carried, load.vehicle, i, "/vehicle");
        alone(held, load.station, i, "/station");
    }
}

}  // namespace pulseline::plant::detail
