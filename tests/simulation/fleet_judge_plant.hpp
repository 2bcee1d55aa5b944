#pragma once

#include <random>

#include "core/plant/plant.hpp"

/// Random plants for the judge of the whole fleet: rows of lanes joined by cross lanes, stations on
/// the rows, bays to rest in beside the outer rows, small vehicles of two types and one platform
/// of 10.5 m that keeps to its row.
namespace pulseline::fleet_judge {

/// `free`: the small vehicles may leave the lanes.
plant::Plant random_plant(std::mt19937_64& random, bool free);

int pick(std::mt19937_64& random, int low, int high);

}  // namespace pulseline::fleet_judge
