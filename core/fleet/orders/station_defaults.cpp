#include "core/fleet/orders/station_defaults.hpp"

#include <utility>

#include "core/fleet/orders/candidates.hpp"
#include "core/fleet/orders/start_conditions.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

const StepAction kLower{vda5050::kLowerParking, {}};
const StepAction kRaise{vda5050::kRaiseParking, {}};

bool all_can_park(const FleetState& fleet, const NewOrder& order, const plant::Station& station) {
    bool any = false;
    for (const auto& [id, live] : fleet.vehicles) {
        if (!is_candidate(fleet, order, live) || !may_stop_at(station, live)) continue;
        any = true;
        const bool can = live.type->parking && announces_at_node(live, kLower) &&
                         announces_at_node(live, kRaise);
        if (!can) return false;
    }
    return any;
}

/// Behind these actions it stands on its feet.
bool ends_on_feet(const std::vector<StepAction>& actions) {
    for (auto last = actions.rbegin(); last != actions.rend(); ++last) {
        if (last->type == vda5050::kLowerParking) return true;
        if (last->type == vda5050::kRaiseParking) return false;
    }
    return false;
}

}  // namespace

NewOrder with_station_defaults(const FleetState& fleet, NewOrder order) {
    bool on_feet = false;  // as the step before leaves it
    for (auto& step : order.steps) {
        const auto* station = plant::find_station(fleet.plant, step.station_number);
        const bool says_before = step.says_before || !step.before.empty();
        const bool says_after = step.says_after || !step.after.empty();
        if (on_feet && !says_before) step.before = {kRaise};
        if (station && station->parks && !says_after && all_can_park(fleet, order, *station)) {
            step.after = {kLower};
        }
        on_feet = ends_on_feet(step.after);
    }
    return order;
}

bool finds_parked(const FleetState& fleet, const JobOrder& order, const LiveVehicle& live) {
    if (order.current_step >= order.steps.size()) return false;
    const Step& step = order.steps[order.current_step];
    if (step.phase != StepPhase::kBefore || !step.before.empty()) return false;
    const auto* here = plant::find_station(fleet.plant, live.record.at_station);
    const auto lock = interlock(fleet, live);
    return here && here->parks && lock && lock->kind == Interlock::Kind::kFeetDown &&
           announces_at_node(live, kRaise);
}

void raise_parked(FleetState& fleet, JobOrder& order, const LiveVehicle& live) {
    if (!finds_parked(fleet, order, live)) return;
    order.steps[order.current_step].before = {kRaise};
    fleet.store(order);
}

}  // namespace pulseline::fleet
