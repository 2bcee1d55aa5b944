#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/traffic/traffic.hpp"

/// Floors, orders and the three ways of running them for the traffic benchmark. One step of all
/// runs is one move of the graph, so the numbers of orders compare.
namespace pulseline::bench {

using traffic::PlaceIndex;

struct World {
    std::string name;
    traffic::MoveGraph graph;
    std::vector<PlaceIndex> starts;  // resting places, one a vehicle
    std::vector<PlaceIndex> goals;
    std::vector<std::uint32_t> zone;  // by place: vehicles get orders of their own zone (hall)
    double step_s = 3;                // duration of every move
    double dwell_s = 9;
    bool well_formed = false;
};

/// 5 halls, each with 40 stations, 200 resting places and 200 vehicles of 1.2 m x 0.8 m.
World halls_world();
/// 1,000 one-cell vehicles between shelves; they start and rest on cells in the shelves' fronts.
World warehouse_world();

struct Run {
    std::vector<double> admission_us;
    std::vector<double> release_us;
    std::vector<double> improve_us;
    std::uint64_t orders = 0;
    std::uint64_t refused = 0;
    std::uint64_t releases = 0;
    std::uint64_t violations = 0;
    double simulated_s = 0;
    double bytes_per_vehicle = 0;
    int stuck = 0;  // vehicles with an order that did not move in the last ten minutes
    double orders_per_hour() const {
        return simulated_s > 0 ? static_cast<double>(orders) * 3600 / simulated_s : 0;
    }
};

double quantile(std::vector<double>& values, double share);

/// At least `seconds` of simulated time, longer until `releases` grants are made.
Run run_traffic(const World& world, double seconds, std::uint64_t releases);
Run run_exclusive_legs(const World& world, double seconds);
Run run_pibt(const World& world, double seconds);

}  // namespace pulseline::bench
