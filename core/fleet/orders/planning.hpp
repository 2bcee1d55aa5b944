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

/// `order` is checked (checks.hpp), `stations` are its steps'.
Result<OrderPlan> plan_order(const FleetState& fleet, const NewOrder& order,
                             const Stations& stations, Time now,
                             FreeManoeuvres free = FreeManoeuvres::kEstimated);
/// As the crow flies, at top speed.
double least_drive_s(const LiveVehicle& live, const Pose2& from, const plant::Station& to);
/// Whether the vehicle stands so near the station's pose that only the stop has to be corrected.
bool nearly_there(const LiveVehicle& live, const Pose2& pose, const plant::Station& station);

}  // namespace pulseline::fleet
