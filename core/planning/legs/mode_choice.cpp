#include "core/planning/legs/mode_choice.hpp"

#include <algorithm>

#include "core/planning/legs/leg_assessment.hpp"
#include "core/plant/free_floor.hpp"

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

/// Whether closed floor bars a way that follows no lanes. Who stands there bars nothing: they may
/// have left by then.
bool is_barred_without_lanes(const LegTask& task, const LegPlan& plan) {
    return plan.route.empty() && std::ranges::any_of(task.closures, [&](const ClosedFloor& one) {
               const auto& over = one.to_loads_only ? plan.loads : plan.closures;
               return !one.stands_only && std::ranges::find(over, one.id) != over.end();
           });
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

void add_way_over_floor(const LegTask& task, GridLegs& grid, bool for_people,
                        std::vector<ModeOption>& options) {
    const auto linear = std::ranges::find(options, plant::MotionMode::kLinear, &ModeOption::mode);
    if (linear == options.end() || !plant::drives_over_free_floor(*task.request.type)) return;
    const auto suggested = std::ranges::find_if(options, &ModeOption::suggested);
    const bool none = suggested == options.end();
    const bool barred = !none && is_barred_without_lanes(task, *suggested->plan);
    if (!none && !barred && (!for_people || linear->plan)) return;
    auto plan = assess_grid(task, grid);
    if (!plan) {
        // Where lanes lead there, why they do not serve says more.
        if (none && task.roads.node(task.station.node) < 0) linear->plan = std::move(plan);
        return;
    }
    if (barred && plan->drawback() >= suggested->plan->drawback()) return;
    if (barred) suggested->suggested = false;
    linear->plan = std::move(plan);
    linear->suggested = none || barred;
}

}  // namespace pulseline::planning
