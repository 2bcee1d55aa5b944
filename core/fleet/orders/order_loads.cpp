#include "core/fleet/orders/order_loads.hpp"

#include <algorithm>
#include <cstddef>

#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/plant/carrying.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

template <class Steps>
bool may_carry(const FleetState& fleet, const Steps& steps, const LiveVehicle& live) {
    const auto may = [&](const StepAction& action) {
        if (action.type != vda5050::kPick) return true;
        const auto* load = find_load(fleet, load_named(action));
        return load != nullptr && !plant::cannot_carry(*live.type, *load);
    };
    return std::ranges::all_of(steps, [&](const auto& step) {
        return std::ranges::all_of(step.before, may) && std::ranges::all_of(step.after, may);
    });
}

/// Whether it is loaded behind these actions, from `done` on.
void change(bool& loaded, const std::vector<StepAction>& actions, std::size_t done = 0) {
    for (std::size_t i = done; i < actions.size(); ++i) {
        if (vda5050::is_transfer(actions[i].type)) loaded = actions[i].type == vda5050::kPick;
    }
}

void change_by_rest(bool& loaded, const JobOrder& order) {
    for (std::size_t i = order.current_step; i < order.steps.size(); ++i) {
        const Step& step = order.steps[i];
        const bool now = i == order.current_step;
        const auto phase = now ? step.phase : StepPhase::kBefore;
        const std::size_t done = now ? step.actions_done : 0;
        if (phase == StepPhase::kBefore) change(loaded, step.before, done);
        change(loaded, step.after, phase == StepPhase::kAfter ? done : 0);
    }
}

}  // namespace

bool may_carry_all(const FleetState& fleet, const NewOrder& order, const LiveVehicle& live) {
    return may_carry(fleet, order.steps, live);
}

bool may_carry_all(const FleetState& fleet, const JobOrder& order, const LiveVehicle& live) {
    return may_carry(fleet, order.steps, live);
}

std::vector<bool> drives_loaded(const FleetState& fleet, const NewOrder& order, JobOrderId self,
                                const LiveVehicle& live) {
    bool loaded = is_loaded(live);
    // Which of many vehicles it will be, and behind what, nobody knows.
    if (!order.vehicle.empty()) {
        for (const JobOrderId& id : fleet.orders.open()) {
            const JobOrder& open = *fleet.find(id);
            const auto& whose =
                open.assigned_vehicle.empty() ? open.wanted_vehicle : open.assigned_vehicle;
            if (id != self && whose == live.record.id) change_by_rest(loaded, open);
        }
    }
    std::vector<bool> drives;
    for (const NewStep& step : order.steps) {
        change(loaded, step.before);
        drives.push_back(loaded);
        change(loaded, step.after);
    }
    return drives;
}

}  // namespace pulseline::fleet
