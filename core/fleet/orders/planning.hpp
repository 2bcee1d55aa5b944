#pragma once

#include <optional>
#include <vector>

#include "core/fleet/orders/checks.hpp"
#include "core/fleet/state/fleet_state.hpp"

/// Which vehicle would serve an order, and how it would drive.
namespace pulseline::fleet {

/// The vehicle that would serve the order and the plan of each step from where it will stand.
struct OrderPlan {
    plant::VehicleId vehicle;
    std::vector<Pose2> starts;  // one per step
    /// Absent: the start is unknown or in place, or the leg is estimated.
    std::vector<std::optional<PlannedLeg>> legs;
    std::vector<double> durations_s;  // 0: start unknown or in place
};

/// Free manoeuvres take too long to be planned on the fleet's own thread (legs/leg_plans.hpp).
enum class FreeManoeuvres { kEstimated, kPlanned };

/// `order` is checked (checks.hpp), `stations` are its steps'. `self`: the order that is planned
/// anew, so that its own end does not count as where a vehicle will stand; empty: a new one.
Result<OrderPlan> plan_order(const FleetState& fleet, const NewOrder& order,
                             const Stations& stations, JobOrderId self, Time now,
                             FreeManoeuvres free = FreeManoeuvres::kEstimated);

}  // namespace pulseline::fleet
