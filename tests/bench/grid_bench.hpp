#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace pulseline::bench {

/// Times every grid search on the maps of a folder (generated ones when empty), prints a table and
/// answers the same figures. Exits with 1 when two searches disagree on a cost.
nlohmann::json bench_grids(const std::string& folder);

}  // namespace pulseline::bench
