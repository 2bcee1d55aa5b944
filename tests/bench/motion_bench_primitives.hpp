#pragma once

#include <nlohmann/json.hpp>

namespace pulseline::bench {

/// Plans every motion mode of every family between random poses, sweeps what the body covers, and
/// prints what both take together. `passed` becomes false when a 99th percentile misses its limit.
nlohmann::json measure_primitives(bool& passed);

}  // namespace pulseline::bench
