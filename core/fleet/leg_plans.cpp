#include "core/fleet/leg_plans.hpp"

#include <cmath>
#include <utility>

#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/state.hpp"
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

/// With the floor that each body holds where it stands: a way that keeps off it is granted.
std::vector<planning::StandingBody> on_held_floor(std::vector<planning::StandingBody> bodies) {
    constexpr std::size_t kAnyHall = 0;  // its tiles lie where those of the others do
    for (auto& body : bodies) {
        std::vector<geometry::Point2> corners;
        for (const auto tile : traffic::tiles_under(kAnyHall, body.outline, kFloorMargin_m)) {
            const auto box = traffic::tile_box(tile);
            corners.insert(
                corners.end(),
                {box.min, {box.max.x_m, box.min.y_m}, box.max, {box.min.x_m, box.max.y_m}});
        }
        body.outline = {geometry::convex_hull(std::move(corners))};
    }
    return bodies;
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

Result<planning::LegPlan> plan_or_ask(FleetState& fleet, VehicleRun& run,
                                      const planning::LegRequest& request, Time now) {
    auto& awaited = run.awaited_plan;
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
    fleet.plans_wanted.insert(run.record.id);
    return under_way();
}

void ask_anew(FleetState& fleet, VehicleRun& run, Time now) {
    auto& awaited = run.awaited_plan;
    const bool known = awaited && awaited->answer && awaited->answer->plan;
    if (!known || now - awaited->asked < kAskAnew) return;
    awaited->question = ++fleet.questions;
    awaited->asked = now;
    fleet.plans_wanted.insert(run.record.id);
}

void Fleet::leg_planned(const plant::VehicleId& id, std::int64_t question,
                        const LegPlanAnswer& answer, Time now) {
    FleetState& fleet = input<&Fleet::leg_planned>(now, id, question, answer);
    VehicleRun* run = fleet.find(id);
    // Whoever asked may want to go elsewhere meanwhile, or floor was closed.
    if (!run || !run->awaited_plan || run->awaited_plan->question != question) return;
    auto& known = run->awaited_plan->answer;
    if (!known || answer.plan) {
        known = answer;
        run->newest_plan.reset();
    }
    dispatch_for(fleet, *run, now);
}

LegPlanAnswer LegPlanAnswerer::answer(const LegPlanQuestion& question) {
    if (tables_ != question.tables) {
        tables_ = question.tables;
        planner_ = tables_->planner.again();
    }
    planner_->set_closures(question.closures);
    auto plan = planner_->plan_leg(question.request, on_held_floor(question.standing));
    if (!plan) return {{}, plan.error().reason};
    return {std::move(*plan), {}};
}

}  // namespace pulseline::fleet
