#include "core/fleet/dispatch/ready_for.hpp"

#include <algorithm>
#include <cstddef>

#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/orders/station_defaults.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

/// The next thing it does, standing, is to raise its feet.
bool raises_feet_first(const JobOrder& order) {
    if (order.current_step >= order.steps.size()) return false;
    const Step& step = order.steps[order.current_step];
    if (step.phase != StepPhase::kBefore) return false;
    const auto todo = step.before.begin() +
                      static_cast<std::ptrdiff_t>(std::min(step.actions_done, step.before.size()));
    return std::any_of(todo, step.before.end(), [](const StepAction& action) {
        return action.type == vda5050::kRaiseParking;
    });
}

/// REQUIRES: it has a step left.
bool is_after_its_stop(const JobOrder& order) {
    return order.steps[order.current_step].phase == StepPhase::kAfter;
}

}  // namespace

std::optional<Barred> not_ready_for(const FleetState& fleet, const JobOrder& order,
                                    const LiveVehicle& live, Time now) {
    auto barred = not_ready(fleet, live, now);
    if (!barred) return std::nullopt;
    // What is broken off in a transfer is begun again; what is done after a stop drives nothing.
    if (barred->by == Bar::kLoad && next_transfer(order, live)) return std::nullopt;
    // It may be what lowers them; the drive behind it is asked for again.
    if (barred->by == Bar::kBracketsRaised && acts_next(order, live)) return std::nullopt;
    const bool stays = acts_next(order, live) && is_after_its_stop(order);
    const bool bars_drives = barred->by == Bar::kFeetDown || barred->by == Bar::kCodesNotSeen ||
                             barred->by == Bar::kWheelFault;
    if (stays && bars_drives) return std::nullopt;
    const bool raised = raises_feet_first(order) || finds_parked(fleet, order, live);
    if (barred->by == Bar::kFeetDown && raised) return std::nullopt;
    return barred;
}

}  // namespace pulseline::fleet
