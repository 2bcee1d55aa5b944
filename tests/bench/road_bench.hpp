#pragma once

#include <nlohmann/json.hpp>

namespace pulseline::bench {

/// Times routes, tables, closures and a dispatch matrix on a roadmap of 10,000 nodes and 40,000
/// directed lanes, beside Boost.Graph's dijkstra_shortest_paths on the same graph; prints and
/// answers the figures. Exits with 1 when the two disagree on a cost.
nlohmann::json bench_roads();

}  // namespace pulseline::bench
