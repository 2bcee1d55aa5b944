#pragma once

#include <string>
#include <vector>

#include "api/plant/moving_ai_file.hpp"

/// Benchmark maps and their problems, from files or made here from fixed seeds.
namespace pulseline::bench {

struct BenchMap {
    std::string name;
    plant::OccupancyGrid grid;
    std::vector<api::plant_file::MovingAiProblem> problems;  // the longest, at most 200
};

/// Every NAME.map of a folder with the problems of all NAME*.scen beside it.
std::vector<BenchMap> maps_in(const std::string& folder);
/// Warehouse with aisles of one cell, rooms with doors, and random obstacles.
std::vector<BenchMap> generated_maps();

}  // namespace pulseline::bench
