#include "core/fleet/orders/planning.hpp"

#include <utility>

#include "core/fleet/legs/leg_plans.hpp"
#include "core/fleet/orders/candidates.hpp"
#include "core/fleet/orders/order_loads.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/leg_request.hpp"
#include "core/fleet/vehicle/readiness.hpp"

namespace pulseline::fleet {
namespace {

std::string step_field(std::size_t step, const char* name) {
    return "/steps/" + std::to_string(step) + "/" + name;
}

Result<OrderPlan> plan_with(const FleetState& fleet, const NewOrder& order,
                            const Stations& stations, const LiveVehicle& live,
                            std::optional<Pose2> pose, JobOrderId self, FreeManoeuvres free) {
    OrderPlan plan;
    plan.vehicle = live.record.id;
    const auto loaded = drives_loaded(fleet, order, self, live);
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        const plant::Station* station = stations[i];
        if (!may_stop_at(*station, live)) {
            return fail(
                Errc::kUnreachable, "station_not_for_type",
                "Station " + std::to_string(station->number) + " is not for vehicles of type " +
                    live.type->name + ". Choose another station or vehicle.",
                step_field(i, "station"),
                {{"station", std::int64_t{station->number}}, {"vehicle_type", live.type->name}});
        }
        const auto from = std::exchange(pose, station->pose);
        plan.starts.push_back(from.value_or(Pose2{}));
        plan.legs.emplace_back();
        plan.durations_s.push_back(0);
        if (!from || nearly_there(live, *from, *station)) continue;
        auto request = leg_request(fleet, live, *from, station->id, order.steps[i].mode);
        request.loaded = loaded[i];
        auto leg = free == FreeManoeuvres::kPlanned ? fleet.planner.plan_leg(request)
                                                    : plan_here(fleet, request);
        if (leg) {
            plan.durations_s.back() = leg->duration_s;
            plan.legs.back() = PlannedLeg{std::move(request), std::move(*leg)};
            continue;
        }
        Error error = leg.error();
        if (error.code == Errc::kNeedsPlan && order.planned_beside) {
            plan.durations_s.back() = least_drive_s(live, *from, *station);
            continue;
        }
        const bool by_mode = order.steps[i].mode != plant::MotionMode::kAuto;
        if (error.field.empty()) error.field = step_field(i, by_mode ? "motion_mode" : "station");
        return fail(std::move(error));
    }
    return plan;
}

}  // namespace

Result<OrderPlan> plan_order(const FleetState& fleet, const NewOrder& order,
                             const Stations& stations, JobOrderId self, Time now,
                             FreeManoeuvres free) {
    if (!order.vehicle.empty()) {
        const LiveVehicle* live = fleet.find(order.vehicle);
        if (is_gone(fleet, *live, now)) {
            return fail(Errc::kConflict, reasons::kVehicleGone,
                        "Vehicle " + order.vehicle.str() +
                            " has been silent for more than 60 s. Bring it back or choose another.",
                        "/vehicle",
                        {{"vehicle", order.vehicle.str()},
                         {"silent_s", seconds(silence(fleet, *live, now))}});
        }
        if (live->record.integration != Integration::kUtilise) {
            return fail(
                Errc::kConflict, "not_integrated",
                "Vehicle " + order.vehicle.str() + " is taken out (" +
                    to_string(live->record.integration) +
                    "). Set its integration to utilise or choose another.",
                "/vehicle",
                {{"vehicle", order.vehicle.str()}, {"level", to_string(live->record.integration)}});
        }
        return plan_with(fleet, order, stations, *live, future_pose(fleet, *live, self), self,
                         free);
    }
    // Any vehicle: the one that gets there soonest; the reason of the nearest miss when none can.
    std::optional<OrderPlan> best;
    double best_s = 0;
    std::optional<Error> why_not;
    for (const auto& [live, pose] :
         nearest_of_each_type(fleet, order, stations.front()->pose, self, now)) {
        auto plan = plan_with(fleet, order, stations, *live, pose, self, free);
        if (!plan) {
            // One that only a plan beside the fleet can judge is not refused for another's reason.
            if (!why_not || plan.error().code == Errc::kNeedsPlan) why_not = plan.error();
            continue;
        }
        double time_s = 0;
        for (const double leg_s : plan->durations_s) time_s += leg_s;
        if (!best || time_s < best_s) {
            best = std::move(*plan);
            best_s = time_s;
        }
    }
    if (best) return std::move(*best);
    if (why_not) return fail(*why_not);
    return fail(Errc::kConflict, reasons::kNoVehicle,
                "No vehicle that this order may have has been heard in the last 60 s. Connect one, "
                "then repeat.",
                "/vehicle");
}

}  // namespace pulseline::fleet
