#include "core/fleet/dispatch/release_withdrawn.hpp"

#include "core/fleet/legs/ending.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/body.hpp"

namespace pulseline::fleet {
namespace {

bool is_bound_to(const FleetState& fleet, const JobOrder& order, const plant::VehicleId& id) {
    return order.wanted_vehicle == id || fleet.orders.vehicle_of_sequence(order.sequence) == id;
}

/// The order waits for another vehicle; the step under way begins anew with that one.
void give_back(FleetState& fleet, JobOrder& order) {
    fleet.orders.release(order);
    if (order.current_step < order.steps.size()) {
        Step& step = order.steps[order.current_step];
        step.state = StepState::kPending;
        step.phase = StepPhase::kBefore;
        step.actions_done = 0;
        step.leg = {};
    }
    fleet.store(order);
}

}  // namespace

void release_withdrawn(FleetState& fleet, Time now) {
    for (auto& [id, live] : fleet.vehicles) {
        if (live.record.integration == Integration::kUtilise || live.has_leg()) continue;
        interrupt(fleet, live, {}, now);  // resumed by a person meanwhile
        JobOrder* order = fleet.orders.of(id);
        if (!order || order->cancel_requested || is_loaded(live)) continue;
        if (order->reason.code != reasons::kVehicleWithdrawn || is_bound_to(fleet, *order, id))
            continue;
        give_back(fleet, *order);
    }
}

}  // namespace pulseline::fleet
