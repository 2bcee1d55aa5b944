#include "core/planning/legs/mode_choice.hpp"

#include <algorithm>

namespace pulseline::planning {
namespace {

// Adjusting takes a pass more for every few millimetres: creep, settle, look.
constexpr double kAdjust_sPerM = 500;
// Beside something the fields of a vehicle slow it down, the more the nearer.
constexpr double kCaution_s = 5;
constexpr double kCaution_m = 1;  // beyond the clearance that must be kept

/// Time until the vehicle stands as it should, but for caution.
double ready_s(const LegTask& task, const LegPlan& plan) {
    const double arm_m = task.request.type->length_m() / 2;
    return plan.duration_s +
           kAdjust_sPerM * (plan.expected.position_m + arm_m * plan.expected.heading_rad);
}

double caution_s(const LegTask& task, const LegPlan& plan) {
    const auto pieces = kinematics::sweep(task.passage.body.pieces, plan.segments);
    const double spare_m =
        task.obstacles.nearest(pieces).distance_m - task.passage.body.clearance_m;
    return kCaution_s * std::clamp(1 - spare_m / kCaution_m, 0.0, 1.0);
}

}  // namespace

void suggest(const LegTask& task, std::vector<ModeOption>& options) {
    std::vector<ModeOption*> feasible;
    for (ModeOption& option : options) {
        if (option.plan) feasible.push_back(&option);
    }
    const auto drawback = [](const ModeOption* option) { return option->plan->drawback(); };
    if (feasible.empty()) return;
    const Drawback least = drawback(*std::ranges::min_element(feasible, {}, drawback));
    std::erase_if(feasible, [&](const ModeOption* option) { return drawback(option) > least; });
    const auto soonest = std::ranges::min_element(
        feasible, {}, [&](const ModeOption* option) { return ready_s(task, *option->plan); });
    // How near a way comes to things costs more to know than all the rest: only where it counts.
    const double limit_s = ready_s(task, *(*soonest)->plan) + kCaution_s;
    std::erase_if(feasible,
                  [&](const ModeOption* option) { return ready_s(task, *option->plan) > limit_s; });
    ModeOption* best = feasible.front();
    if (feasible.size() > 1) {
        best = *std::ranges::min_element(feasible, {}, [&](const ModeOption* option) {
            return ready_s(task, *option->plan) + caution_s(task, *option->plan);
        });
    }
    best->suggested = true;
}

}  // namespace pulseline::planning
