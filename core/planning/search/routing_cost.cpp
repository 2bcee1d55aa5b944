#include "core/planning/search/routing_cost.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/angle.hpp"

namespace pulseline::planning {

bool is_turn(const plant::RoutingCost& cost, double heading_rad, double next_heading_rad) {
    return std::abs(wrap(next_heading_rad - heading_rad)) > cost.turn_threshold_rad;
}

double edge_cost(const plant::RoutingCost& cost, double length_m, bool turn) {
    const double charge = turn ? (cost.k_diff - cost.k_same) * cost.reference_step_m : 0;
    return std::max(0.0, cost.k_same * length_m + charge);
}

Status check(const plant::RoutingCost& cost) {
    const std::pair<const char*, double> numbers[] = {
        {"k_same", cost.k_same},
        {"k_diff", cost.k_diff},
        {"reference_step_m", cost.reference_step_m},
        {"turn_threshold_rad", cost.turn_threshold_rad},
        {"accuracy_k", cost.accuracy_k}};
    for (const auto& [name, value] : numbers) {
        if (std::isfinite(value) && value >= 0) continue;
        return fail(Errc::kInvalid, "routing_cost_invalid",
                    std::string("The routing cost ") + name + " must be a number of at least 0.",
                    std::string("/routing/") + name, {{"name", std::string(name)}});
    }
    return {};
}

}  // namespace pulseline::planning
