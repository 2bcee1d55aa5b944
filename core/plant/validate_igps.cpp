#include <algorithm>
#include <cmath>
#include <map>

#include "core/plant/validate_parts.hpp"

namespace pulseline::plant::detail {
namespace {

constexpr std::size_t kMostInHall = 16;  // bounds what a vehicle has to work out 25 times a second
constexpr double kSameRate_hz = 0.01;    // closer, one gains less than a turn in 100 s
constexpr double kReceiversApart_m = 0.1;  // closer, 0.1 mm of noise is over 1 mrad of heading
constexpr std::size_t kFewest = 2;         // one direction gives no place, one place no heading

/// Indices of transmitters.
using ByHall = std::map<HallId, std::vector<std::size_t>>;

ByHall transmitters_by_hall(const Plant& plant) {
    ByHall by_hall;
    for (std::size_t i = 0; i < plant.transmitters.size(); ++i) {
        by_hall[plant.transmitters[i].hall].push_back(i);
    }
    return by_hall;
}

void check_places(const Plant& plant, const Index& index, Faults& faults) {
    for (std::size_t i = 0; i < plant.transmitters.size(); ++i) {
        const auto* hall = look_up(index.halls, plant.transmitters[i].hall);
        if (hall != nullptr &&
            !geometry::contains((*hall)->outline, plant.transmitters[i].position)) {
            faults.add(at("transmitters", i, "/position"), "outside_hall",
                       "The transmitter stands outside its hall.",
                       "Correct the position or the hall.");
        }
    }
}

/// `here`: those of one hall.
void check_rates(const Plant& plant, const std::vector<std::size_t>& here, Faults& faults) {
    if (here.size() > kMostInHall) {
        const Transmitter& first_too_many = plant.transmitters[here[kMostInHall]];
        faults.add(at("transmitters", here[kMostInHall]), "too_many_transmitters",
                   "Hall " + quoted(first_too_many.hall.str()) + " has " +
                       std::to_string(here.size()) + " transmitters.",
                   "Keep at most " + std::to_string(kMostInHall) + " in a hall.");
        return;
    }
    const auto rate_hz = [&](std::size_t i) { return plant.transmitters[i].rate_hz; };
    for (auto later = here.begin(); later != here.end(); ++later) {
        const auto same = std::find_if(here.begin(), later, [&](std::size_t earlier) {
            return std::abs(rate_hz(earlier) - rate_hz(*later)) < kSameRate_hz;
        });
        if (same == later) continue;
        faults.add(at("transmitters", *later, "/rate_hz"), "same_rate",
                   "It turns as fast as " + at("transmitters", *same) + " of the same hall.",
                   "Give each its own rate: receivers tell them apart by it.");
    }
}

void check_receivers(const VehicleType& type, const std::string& element, Faults& faults) {
    if (type.receivers.empty()) return;
    if (type.receivers.size() < kFewest) {
        faults.add(element, "one_receiver", "One receiver alone tells no direction.",
                   "List another one, or none.");
        return;
    }
    // Any two of them may be all that sees light.
    for (std::size_t i = 1; i < type.receivers.size(); ++i) {
        const auto end = type.receivers.begin() + static_cast<std::ptrdiff_t>(i);
        const bool near = std::any_of(type.receivers.begin(), end, [&](const Receiver& other) {
            return geometry::distance(other.position, type.receivers[i].position) <
                   kReceiversApart_m;
        });
        if (!near) continue;
        faults.add(element + "/" + std::to_string(i) + "/position", "receivers_too_near",
                   "Two receivers sit at one place, which tells no direction.",
                   "Mount them as far apart as the vehicle allows, at least 0.1 m.");
    }
}

void check_enough(const Plant& plant, const Index& index, const ByHall& by_hall, Faults& faults) {
    for (std::size_t i = 0; i < plant.vehicles.size(); ++i) {
        const auto* type = look_up(index.types, plant.vehicles[i].type);
        const auto* home = look_up(index.stations, plant.vehicles[i].home);
        if (type == nullptr || home == nullptr || (*type)->receivers.empty()) continue;
        const HallId& hall = plant.stations[*home].hall;
        const auto* here = look_up(by_hall, hall);
        if (here != nullptr && here->size() >= kFewest) continue;
        faults.add(
            at("vehicles", i, "/type"), "too_few_transmitters",
            "Its receivers need two transmitters at least in hall " + quoted(hall.str()) + ".",
            "Add transmitters there, or leave the receivers out of the type.");
    }
}

}  // namespace

void check_igps(const Plant& plant, const Index& index, Faults& faults) {
    const ByHall by_hall = transmitters_by_hall(plant);
    check_places(plant, index, faults);
    for (const auto& [hall, here] : by_hall) check_rates(plant, here, faults);
    for (std::size_t i = 0; i < plant.vehicle_types.size(); ++i) {
        check_receivers(plant.vehicle_types[i], at("vehicle_types", i, "/receivers"), faults);
    }
    check_enough(plant, index, by_hall, faults);
}

}  // namespace pulseline::plant::detail
