#include "core/fleet/dispatch/step_leg.hpp"

#include "core/fleet/floor/closures.hpp"
#include "core/fleet/legs/leg_plans.hpp"
#include "core/fleet/legs/step_actions.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/leg_build.hpp"
#include "core/fleet/vehicle/leg_request.hpp"

namespace pulseline::fleet {
namespace {

Result<planning::LegPlan> plan_step(FleetState& fleet, LiveVehicle& live, const Step& step,
                                    Time now) {
    // The measured pose, not the theoretical one, starts the leg (Tang 2020, section 3.2).
    auto request = leg_request(fleet, live, live.record.pose, step.station, step.mode);
    ask_anew(fleet, live, now);
    if (!live.newest_plan || live.newest_plan->request != request) {
        auto plan = plan_or_ask(fleet, live, request, now);
        if (!plan) return plan;
        live.newest_plan = PlannedLeg{std::move(request), std::move(*plan)};
    }
    return live.newest_plan->plan;
}

}  // namespace

Result<StepLeg> leg_of_step(FleetState& fleet, JobOrder& order, LiveVehicle& live,
                            const plant::Station& station, LegId id, Time now) {
    if (auto actions = next_actions_leg(fleet, order, live, id)) {
        return StepLeg{std::move(*actions), false};
    }
    if (nearly_there(live, live.record.pose, station)) {
        return StepLeg{build_adjust_leg(fleet, live, station, live.record.pose, id), true};
    }
    const auto plan = plan_step(fleet, live, order.steps[order.current_step], now);
    if (!plan) return fail(plan.error());
    return StepLeg{build_leg(fleet, live, *plan, station, live.record.pose, id), false};
}

void name_what_cuts_off(FleetState& fleet, LiveVehicle& live, const Step& step, Reason& reason,
                        Time now) {
    if (reason.code != reasons::kFloorClosed) return;
    const auto plan = plan_step(fleet, live, step, now);
    if (plan) name_closures(fleet, plan->closures, reason);
}

}  // namespace pulseline::fleet
