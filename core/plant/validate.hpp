#pragma once

#include <string>
#include <vector>

#include "core/plant/plant.hpp"

namespace pulseline::plant {

struct Fault {
    std::string element;  // JSON pointer into the plant file, e.g. "/stations/3/markers/0"
    std::string code;     // stable, e.g. "unknown_marker"
    std::string what;     // what is wrong
    std::string remedy;   // what to do about it
};

/// Every fault of the plant, not just the first: duplicate or dangling keys, stations outside their
/// hall or on an obstacle, a home too small for its vehicle, markers that the cameras of a vehicle
/// standing at the station cannot see, transmitters or reflectors that cannot be told apart, too
/// few of them for a vehicle that navigates by them, unreachable stations, non-finite numbers, bad
/// limits.
std::vector<Fault> validate(const Plant& plant);
/// What is known of a load that people name while the plant is at work; not where it is. Elements
/// point into the load.
std::vector<Fault> validate_load(const Plant& plant, const Load& load);

}  // namespace pulseline::plant
