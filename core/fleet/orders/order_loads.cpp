#include "core/fleet/orders/order_loads.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/plant/carrying.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

template <class Steps>
std::optional<Reason> cannot_carry(const FleetState& fleet, const Steps& steps,
                                   const LiveVehicle& live) {
    for (const auto& step : steps) {
        for (const auto* actions : {&step.before, &step.after}) {
            for (const StepAction& action : *actions) {
                if (action.type != vda5050::kPick) continue;
                const auto* load = find_load(fleet, load_named(action));
                if (!load) return Reason{"unknown_load", {{"load", load_named(action).str()}}};
                if (auto why_not = plant::cannot_carry(*live.type, *load)) return why_not;
            }
        }
    }
    return std::nullopt;
}

std::span<const Step> steps_left(const JobOrder& order) {
    const auto done = static_cast<std::size_t>(order.current_step);
    return std::span(order.steps).subspan(std::min(done, order.steps.size()));
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

std::optional<Reason> cannot_carry_all(const FleetState& fleet, const NewOrder& order,
                                       const LiveVehicle& live) {
    return cannot_carry(fleet, order.steps, live);
}

std::optional<Reason> cannot_carry_all(const FleetState& fleet, const JobOrder& order,
                                       const LiveVehicle& live) {
    return cannot_carry(fleet, steps_left(order), live);
}

const JobOrder* order_of_load(const FleetState& fleet, const plant::LoadId& load) {
    const auto takes_it = [&](const StepAction& action) {
        return action.type == vda5050::kPick && load_named(action) == load;
    };
    for (const JobOrderId& id : fleet.orders.open()) {
        const JobOrder& order = *fleet.find(id);
        for (const Step& step : steps_left(order)) {
            if (std::ranges::any_of(step.before, takes_it) ||
                std::ranges::any_of(step.after, takes_it))
                return &order;
        }
    }
    return nullptr;
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
