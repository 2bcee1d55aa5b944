#pragma once

#include <random>

#include "core/plant/plant.hpp"

/// Random plants for the judge of the whole fleet: rows of lanes joined by cross lanes, stations on
/// the rows, bays to rest in beside the outer rows, small vehicles of two types and platforms of
/// 10.5 m that keep to their rows, with an aircraft each.
namespace pulseline::fleet_judge {

/// `free`: the small vehicles may leave the lanes. `several`: platforms, up to two in a row, where
/// there is one else.
plant::Plant random_plant(std::mt19937_64& random, bool free, bool several);

const plant::Station& home_of(const plant::Plant& plant, const plant::VehicleId& id);

int pick(std::mt19937_64& random, int low, int high);

}  // namespace pulseline::fleet_judge
