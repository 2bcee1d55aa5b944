#include "core/planning/grid/grid_cost.hpp"

#include <cmath>

namespace pulseline::planning {
namespace {

// Costs of a cell beyond this could overflow on the largest grid.
constexpr double kLargestCost = 1e9;

/// From the costs of a cell entered straight and of one entered after a change of direction.
Result<GridCost> rounded(double straight, double turned) {
    for (const double value : {straight, turned}) {
        if (!std::isfinite(value) || std::abs(value) > kLargestCost) {
            return fail(Errc::kInvalid, "routing_cost_invalid",
                        "The routing costs k_same and k_diff must be between 0 and 1e9.");
        }
    }
    const std::int64_t step = std::llround(straight * kCostUnit);
    return GridCost{
        step, std::max(std::int64_t{0}, std::int64_t{std::llround(turned * kCostUnit)}) - step};
}

}  // namespace

Result<GridCost> unit_cell_cost(double k_same, double k_diff) {
    return check({k_same, k_diff, 1, 0}).and_then([&] { return rounded(k_same, k_diff); });
}

Result<GridCost> hall_cost(const plant::RoutingCost& cost, double resolution_m) {
    return check(cost).and_then([&] {
        const double step = cost.k_same * resolution_m;
        return rounded(step, step + (cost.k_diff - cost.k_same) * cost.reference_step_m);
    });
}

}  // namespace pulseline::planning
