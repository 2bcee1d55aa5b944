#include "core/fleet/legs/leg_plans.hpp"

#include <cmath>

#include "core/fleet/state/fleet_state.hpp"
#include "core/geometry/pose2.hpp"

namespace pulseline::fleet {
namespace {

/// A question is lost with a batch that could not be stored, or by a thread that is too busy.
constexpr Duration kAskAgain = std::chrono::seconds(5);
/// A way that others bar is looked for anew.
constexpr Duration kAskAnew = std::chrono::seconds(10);
// A vehicle's standing pose trembles; a plan from where it stood by less is as good.
constexpr double kSamePlace_m = 0.01;
constexpr double kSamePlace_rad = 0.005;

bool same_place(const Pose2& a, const Pose2& b) {
    const Pose2 off = geometry::inverse(a) * b;
    return std::hypot(off.x_m, off.y_m) <= kSamePlace_m &&
           std::abs(off.heading_rad) <= kSamePlace_rad;
}

bool answers(const AwaitedPlan& known, planning::LegRequest request) {
    if (!same_place(known.request.start, request.start)) return false;
    request.start = known.request.start;
    return known.request == request;
}

tl::unexpected<Error> under_way() {
    return fail(Error{Errc::kNeedsPlan,
                      {"plan_under_way", {}},
                      "The way is being planned. Wait a few seconds, then repeat.",
                      {}});
}

}  // namespace

Result<planning::LegPlan> plan_here(const FleetState& fleet, const planning::LegRequest& request) {
    const bool may_need_free = planning::may_need_free_manoeuvre(request);
    if (request.mode == plant::MotionMode::kFree && may_need_free) return under_way();
    auto plan = fleet.planner.plan_primitive_leg(request);
    if (plan || !may_need_free) return plan;
    return under_way();
}

Result<planning::LegPlan> plan_or_ask(FleetState& fleet, LiveVehicle& live,
                                      const planning::LegRequest& request, Time now) {
    auto& awaited = live.awaited_plan;
    if (awaited && answers(*awaited, request)) {
        if (const auto& answer = awaited->answer) {
            if (answer->plan) return *answer->plan;
            return fail(Error{Errc::kConflict, answer->why_not, "There is no such way.", {}});
        }
        if (now - awaited->asked < kAskAgain) return under_way();
    } else {
        auto plan = plan_here(fleet, request);
        if (plan || plan.error().code != Errc::kNeedsPlan) return plan;
    }
    awaited = AwaitedPlan{++fleet.questions, request, now, {}};
    fleet.plans_wanted.insert(live.record.id);
    return under_way();
}

void ask_anew(FleetState& fleet, LiveVehicle& live, Time now) {
    auto& awaited = live.awaited_plan;
    const bool known = awaited && awaited->answer && awaited->answer->plan;
    if (!known || now - awaited->asked < kAskAnew) return;
    awaited->question = ++fleet.questions;
    awaited->asked = now;
    fleet.plans_wanted.insert(live.record.id);
}

}  // namespace pulseline::fleet
