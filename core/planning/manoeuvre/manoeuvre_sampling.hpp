#pragma once

#include <cstdint>

#include "core/planning/manoeuvre/manoeuvre_path.hpp"

namespace pulseline::planning {

enum class SamplingPlanner { kRrtConnect, kBiEst };

/// Random search by OMPL over the poses of a hall. Moves to the goal, or none within `work_limit`
/// tests of the room.
///
/// Deterministic by seed, whatever ran before in the process: all randomness comes from the state
/// sampler and from the planner's own generator, both seeded here (OMPL's global seed, which can be
/// set only once, decides nothing: planners that draw from generators of their own inside, such as
/// KPIECE's, are not offered for that reason), and the end is counted, not timed.
/// Thread safety: any number at once. OMPL's messages are switched off for the whole process.
Moves sampling_search(const ManoeuvreTask& task, SamplingPlanner planner, std::uint64_t seed,
                      long work_limit);

}  // namespace pulseline::planning
