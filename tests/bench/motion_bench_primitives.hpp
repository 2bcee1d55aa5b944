#pragma once

#include <nlohmann/json.hpp>

namespace pulseline::bench {

/// Plans every motion mode of every family between random poses, sweeps what the body covers, and
/// prints what both take together; true when the 99th percentile keeps to its limit.
bool bench_primitives(nlohmann::json& out);

}  // namespace pulseline::bench
