#pragma once

#include <nlohmann/json.hpp>

namespace pulseline::bench {

/// Times a step of the dynamic window, a check of the protective fields and a scan of the simulated
/// scanner, and prints p50 and p99 of each. `passed` becomes false when one takes longer than is
/// asked of it.
nlohmann::json measure_control(bool& passed);

}  // namespace pulseline::bench
