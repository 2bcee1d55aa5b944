#include <map>

#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

constexpr double kApart_m = 0.5;              // closer, their echoes run into each other from afar
constexpr std::size_t kFewestReflectors = 3;  // two fit two poses
constexpr std::size_t kMostReflectors = 200;

void check_reflector_places(const Plant& plant, const Index& index, Faults& faults) {
    for (std::size_t i = 0; i < plant.reflectors.size(); ++i) {
        const Reflector& here = plant.reflectors[i];
        const auto* hall = look_up(index.halls, here.hall);
        if (hall != nullptr && !geometry::contains((*hall)->outline, here.position)) {
            faults.add(at("reflectors", i, "/position"), "outside_hall",
                       "The reflector stands outside its hall.",
                       "Correct its position, or the outline of the hall.");
        }
        for (std::size_t j = 0; j < i; ++j) {
            const Reflector& other = plant.reflectors[j];
            if (other.hall != here.hall ||
                geometry::distance(other.position, here.position) >= kApart_m)
                continue;
            faults.add(at("reflectors", i, "/position"), "reflectors_too_near",
                       "It stands so near " + at("reflectors", j) + " that a scanner sees one.",
                       "Keep reflectors at least 0.5 m apart.");
        }
    }
}

void check_reflector_count(const Plant& plant, Faults& faults) {
    std::map<HallId, std::size_t> here;
    for (std::size_t i = 0; i < plant.reflectors.size(); ++i) {
        if (++here[plant.reflectors[i].hall] != kMostReflectors + 1) continue;
        faults.add(at("reflectors", i), "too_many_reflectors",
                   "Its hall has more than " + std::to_string(kMostReflectors) + " reflectors.",
                   "Keep those that vehicles need; three in view tell a pose.");
    }
}

void check_enough_reflectors(const Plant& plant, const Index& index, Faults& faults) {
    for (std::size_t i = 0; i < plant.vehicles.size(); ++i) {
        const auto* type = look_up(index.types, plant.vehicles[i].type);
        const auto* home = look_up(index.stations, plant.vehicles[i].home);
        if (type == nullptr || home == nullptr || !(*type)->navigation_scanner) continue;
        const HallId& hall = plant.stations[*home].hall;
        std::size_t here = 0;
        for (const Reflector& reflector : plant.reflectors) here += reflector.hall == hall ? 1 : 0;
        if (here >= kFewestReflectors) continue;
        faults.add(at("vehicles", i, "/type"), "too_few_reflectors",
                   "Its navigation scanner needs three reflectors at least in hall " +
                       quoted(hall.str()) + ".",
                   "Add reflectors there, or leave the scanner out of the type.");
    }
}

}  // namespace

void check_reflectors(const Plant& plant, const Index& index, Faults& faults) {
    check_reflector_places(plant, index, faults);
    check_reflector_count(plant, faults);
    check_enough_reflectors(plant, index, faults);
}

}  // namespace pulseline::plant::detail
