#pragma once

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

/// The cost of a route (Li 2022 eq. 10, corrected), the same on grids and on roads: k_same x length
/// and a fixed charge for each change of direction.
namespace pulseline::planning {

/// Integer costs are thousandths of k, so that sums are exact.
constexpr double kCostUnit = 1000;

bool is_turn(const plant::RoutingCost& cost, double heading_rad, double next_heading_rad);
/// Cost of driving one edge. Never below 0: with k_diff < k_same on lanes shorter than the
/// reference step, going to and fro would pay otherwise and no route would be the best.
double edge_cost(const plant::RoutingCost& cost, double length_m, bool turn);
Status check(const plant::RoutingCost& cost);

}  // namespace pulseline::planning
