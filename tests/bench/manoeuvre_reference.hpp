#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/manoeuvre_scene.hpp"

namespace pulseline::bench {

/// Queries of the manoeuvre bench with the length of the best path that OMPL's RRT* finds for each
/// in `seconds`, by OMPL's own Reeds-Shepp space and motion validator. Three in four are far. A
/// query that neither RRTConnect nor RRT* solves is drawn anew. Written to `path` after each one,
/// so that an interrupted run goes on where it stopped.
void make_reference(const std::string& path, int count, double seconds, std::uint64_t seed,
                    const std::string& date);
std::vector<ManoeuvreQuery> read_reference(const std::string& path);

}  // namespace pulseline::bench
