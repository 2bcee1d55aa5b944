#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/core/fleet/fleet_world.hpp"

/// Halls in which vehicles get in each other's way.
namespace pulseline::fleet::testing {

struct Spot {
    const char* name;
    double x_m;
    double y_m;
    int station = 0;  // number; 0: only a node
};

/// A hall of stations and nodes joined by two-way lanes; every station is a resting place. Vehicles
/// stand at the first stations.
plant::Plant plant_of(const std::vector<Spot>& spots,
                      const std::vector<std::pair<const char*, const char*>>& lanes, int vehicles);
/// Two ends of a lane (stations 1, 2) with a bay (3) beside its middle; a vehicle at each end.
plant::Plant corridor();
/// Two ways from west (1) to east (2), the upper one longer; stations 3 on the lower one and 4
/// behind the east; vehicles at 1 and 2.
plant::Plant two_ways();

/// All vehicles connect and know where they stand.
void confirm_poses(World& world);
/// The vehicle's order; without one an order without id.
JobOrder order_of(const World& world, const std::string& vehicle);
/// Closes the floor between two abscissae of the lane at y = 40 m.
Closure close_lane(World& world, double from_x_m, double to_x_m);

}  // namespace pulseline::fleet::testing
