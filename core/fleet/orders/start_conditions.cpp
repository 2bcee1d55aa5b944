#include "core/fleet/orders/start_conditions.hpp"

#include <algorithm>
#include <set>

#include "core/fleet/orders/order_loads.hpp"
#include "core/fleet/state/fleet_state.hpp"

namespace pulseline::fleet {
namespace {

std::string name_of(std::int64_t number) { return "JO-" + std::to_string(number); }

std::optional<JobState> outcome_of(const FleetState& fleet, const Dependency& dependency) {
    if (dependency.outcome) return dependency.outcome;
    if (fleet.orders.open().contains(dependency.order)) return std::nullopt;
    const auto order = fleet.orders.look_up(dependency.order);
    // Unknown: it was settled before the fleet forgot it, or its rows are gone. Never start on it.
    return order ? order->state : JobState::kAborted;
}

std::optional<Reason> waits_for_dependency(const FleetState& fleet, const JobOrder& order) {
    for (const Dependency& dependency : order.after) {
        const auto outcome = outcome_of(fleet, dependency);
        if (outcome == JobState::kEnded) continue;
        return Reason{outcome ? "dependency_aborted" : "dependency_open",
                      {{"order", name_of(dependency.number)}}};
    }
    return std::nullopt;
}

std::optional<Reason> waits_for_sequence(const FleetState& fleet, const JobOrder& order) {
    if (order.sequence.empty()) return std::nullopt;
    const JobOrderId first = *fleet.orders.sequence(order.sequence).begin();
    if (first != order.id) {
        return Reason{
            "sequence_earlier",
            {{"order", name_of(fleet.find(first)->number)}, {"sequence", order.sequence}}};
    }
    const auto vehicle = fleet.orders.vehicle_of_sequence(order.sequence);
    const JobOrder* other = vehicle.empty() ? nullptr : fleet.orders.of(vehicle);
    if (!other) return std::nullopt;
    return Reason{"sequence_vehicle_busy",
                  {{"vehicle", vehicle.str()},
                   {"order", name_of(other->number)},
                   {"sequence", order.sequence}}};
}

/// The sequence that keeps the vehicle from the order; empty: none does. What a member of the
/// sequence waits for may have the vehicle, or both would wait for ever.
std::string keeper(const FleetState& fleet, const JobOrder& order, const plant::VehicleId& id) {
    std::string name = fleet.orders.sequence_of(id);
    if (name.empty() || name == order.sequence) return {};
    const auto& members = fleet.orders.sequence(name);
    const bool needed = std::any_of(members.begin(), members.end(), [&](const JobOrderId& member) {
        return depends_on(fleet, *fleet.find(member), order.id);
    });
    return needed ? std::string() : name;
}

}  // namespace

bool announces_at_node(const LiveVehicle& live, const StepAction& action) {
    if (!live.factsheet) return false;
    const auto& known = live.factsheet->node_actions;
    return std::find(known.begin(), known.end(), action.type) != known.end();
}

const StepAction* unannounced_action(const JobOrder& order, const LiveVehicle& live) {
    for (const Step& step : order.steps) {
        for (const auto* actions : {&step.before, &step.after}) {
            for (const StepAction& action : *actions) {
                if (!announces_at_node(live, action)) return &action;
            }
        }
    }
    return nullptr;
}

std::optional<Reason> waits_for_condition(const FleetState& fleet, const JobOrder& order,
                                          Time now) {
    if (order.earliest_start && now < *order.earliest_start) {
        return Reason{"earliest_start",
                      {{"at_unix_s", to_ns(*order.earliest_start) / 1'000'000'000}}};
    }
    if (auto reason = waits_for_dependency(fleet, order)) return reason;
    if (auto reason = waits_for_sequence(fleet, order)) return reason;
    const plant::VehicleId vehicle =
        !order.wanted_vehicle.empty() ? order.wanted_vehicle : order.sequence_vehicle;
    const LiveVehicle* live = fleet.find(vehicle);
    if (!live) return std::nullopt;
    if (const std::string name = keeper(fleet, order, vehicle); !name.empty()) {
        return Reason{"vehicle_kept", {{"vehicle", vehicle.str()}, {"sequence", name}}};
    }
    if (const StepAction* action = unannounced_action(order, *live)) {
        return Reason{"actions_not_announced",
                      {{"vehicle", vehicle.str()}, {"action", action->type}}};
    }
    return cannot_carry_all(fleet, order, *live);  // by what is known of its loads since
}

bool vehicle_fits(const FleetState& fleet, const JobOrder& order, const LiveVehicle& live) {
    const plant::VehicleId& id = live.record.id;
    if (!order.wanted_vehicle.empty() && order.wanted_vehicle != id) return false;
    if (!order.wanted_type.empty() && order.wanted_type != live.type->id) return false;
    const auto bound = fleet.orders.vehicle_of_sequence(order.sequence);
    if (!bound.empty() && bound != id) return false;
    if (!keeper(fleet, order, id).empty()) return false;
    return unannounced_action(order, live) == nullptr && !cannot_carry_all(fleet, order, live);
}

void settle_dependencies(FleetState& fleet) {
    for (const JobOrderId& id : fleet.orders.open()) {
        JobOrder& order = *fleet.find(id);
        bool changed = false;
        for (Dependency& dependency : order.after) {
            if (dependency.outcome) continue;
            dependency.outcome = outcome_of(fleet, dependency);
            changed = changed || dependency.outcome.has_value();
        }
        if (changed) fleet.store(order);
    }
}

bool depends_on(const FleetState& fleet, const JobOrder& order, JobOrderId on,
                const JobOrder* changed) {
    const auto look_up = [&](const JobOrderId& id) {
        return changed && changed->id == id ? changed : fleet.find(id);
    };
    std::set<JobOrderId> seen;
    std::vector<const JobOrder*> todo{&order};
    while (!todo.empty()) {
        const JobOrder* next = todo.back();
        todo.pop_back();
        std::vector<JobOrderId> waited_for;
        for (const Dependency& dependency : next->after) waited_for.push_back(dependency.order);
        for (const JobOrderId& member : fleet.orders.sequence(next->sequence)) {
            const bool moved = changed && changed->id == member;
            if (member < next->id && !moved) waited_for.push_back(member);
        }
        if (changed && !next->sequence.empty() && changed->sequence == next->sequence &&
            changed->id < next->id) {
            waited_for.push_back(changed->id);
        }
        for (const JobOrderId& id : waited_for) {
            if (id == on) return true;
            const JobOrder* found = look_up(id);
            if (found && !is_final(found->state) && seen.insert(id).second) todo.push_back(found);
        }
    }
    return false;
}

}  // namespace pulseline::fleet
