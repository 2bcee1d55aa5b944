#include "core/planning/legs/leg_assessment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/kinematics/primitives.hpp"
#include "core/kinematics/trajectory.hpp"
#include "core/planning/legs/blind_way.hpp"

namespace pulseline::planning {
namespace {

using geometry::Polygon;
using kinematics::Segment;
using plant::MotionMode;

tl::unexpected<Error> blocked(const Approach& by, double limit_m) {
    const char* what = by.what == "wall"  ? "a wall"
                       : by.what == "map" ? "an obstacle of the map"
                                          : by.what.c_str();
    return fail(Errc::kUnreachable, "blocked",
                std::string("The swept area comes too near to ") + what +
                    ". Choose another motion mode or station.",
                {},
                {{"by", by.what},
                 {"at_x_m", by.at.x_m},
                 {"at_y_m", by.at.y_m},
                 {"clearance_m", by.distance_m},
                 {"limit_m", limit_m}});
}

/// Changes of direction of a direct motion; the turn on arrival does not count.
int turns_of(const LegTask& task, const kinematics::MotionPlan& motion) {
    double first_turn = 0;
    for (const Segment& segment : motion.segments) {
        if (segment.kind == Segment::Kind::kArc) return 1;
        if (segment.kind != Segment::Kind::kRotate) break;
        first_turn += std::abs(segment.turn_rad);
    }
    return first_turn > task.cost.turn_threshold_rad ? 1 : 0;
}

LegDraft draft_direct(const LegTask& task, const kinematics::MotionPlan& motion) {
    LegDraft draft;
    draft.segments = motion.segments;
    draft.turns = turns_of(task, motion);
    draft.cost = edge_cost(task.cost, motion.length_m, draft.turns > 0);
    for (const Segment& segment : draft.segments) {
        draft.max_speed_mps.push_back(
            task.roads.lines().along(task.request.hall, segment).max_speed_mps);
    }
    kinematics::set_durations(*task.request.type, draft.segments, draft.max_speed_mps);
    return draft;
}

kinematics::ExpectedDeviation expected_of(const plant::VehicleType& type,
                                          const std::vector<Segment>& segments) {
    return kinematics::expected_deviation(segments, kinematics::usual_noise(type.kinematics));
}

/// Of a direct motion. Floor closed in a lane's corridor closes the lane, here too.
std::vector<std::size_t> closed_floor_on(const LegTask& task, const std::vector<Segment>& segments,
                                         std::vector<Polygon> swept) {
    const double reach_m = plant::reach_m(task.passage.body.pieces);
    for (const Segment& segment : segments) {
        const auto corridor = task.roads.lines().along(task.request.hall, segment).corridor;
        if (!corridor) continue;
        swept.push_back(plant::corridor_band(segment.start.position(), segment.end.position(),
                                             *corridor, reach_m));
    }
    return driven_over(task.closures, task.request.hall, swept);
}

/// Lanes of two halls may be one closure.
void add_once(std::vector<std::string>& ids, const std::string& id) {
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
}

/// The plan of a draft that keeps clear; `pieces` are its swept area.
LegPlan cleared(const LegTask& task, MotionMode mode, LegDraft draft,
                const std::vector<Polygon>& pieces) {
    const auto sums = kinematics::summed(mode, std::move(draft.segments));
    LegPlan plan;
    plan.mode = mode;
    plan.segments = sums.segments;
    plan.max_speed_mps = std::move(draft.max_speed_mps);
    plan.route = std::move(draft.route);
    plan.length_m = sums.length_m;
    plan.turns = draft.turns;
    plan.cost = draft.cost;
    plan.accuracy = draft.accuracy;
    plan.duration_s = sums.duration_s;
    plan.expected = expected_of(*task.request.type, plan.segments);
    plan.blind = blind_way(task, plan.segments);
    if (plan.route.empty()) draft.closures = closed_floor_on(task, plan.segments, pieces);
    for (const std::size_t closure : draft.closures) {
        const ClosedFloor& closed = task.closures[closure];
        add_once(closed.to_loads_only ? plan.loads : plan.closures, closed.id);
    }
    return plan;
}

/// The first plan of the least drawback, or why the first is blocked.
class Best {
public:
    /// True: nothing better is to be had.
    bool offer(Result<LegPlan> plan) {
        if (!plan) {
            if (!refusal_) refusal_ = plan.error();
            return false;
        }
        if (!plan_ || plan->drawback() < plan_->drawback()) plan_ = std::move(*plan);
        return plan_->drawback() == Drawback::kNone;
    }
    bool has_plan() const { return plan_.has_value(); }
    Result<LegPlan> take() {
        if (plan_) return std::move(*plan_);
        return fail(std::move(*refusal_));
    }

private:
    std::optional<LegPlan> plan_;
    std::optional<Error> refusal_;
};

}  // namespace

Result<LegPlan> finish(const LegTask& task, MotionMode mode, LegDraft draft) {
    const auto pieces = kinematics::sweep(task.passage.body.pieces, draft.segments);
    if (const auto by = task.obstacles.violation(pieces, task.limits)) {
        return blocked(*by, task.passage.body.clearance_m);
    }
    return cleared(task, mode, std::move(draft), pieces);
}

LegPlan joined(const plant::VehicleType& type, const LegPlan& first, const LegPlan& rest) {
    LegPlan plan = rest;
    auto segments = first.segments;
    segments.insert(segments.end(), rest.segments.begin(), rest.segments.end());
    const auto sums = kinematics::summed(rest.mode, std::move(segments));
    plan.segments = sums.segments;
    if (!plan.max_speed_mps.empty()) {
        plan.max_speed_mps.insert(plan.max_speed_mps.begin(), first.segments.size(), 0.0);
    }
    plan.length_m = sums.length_m;
    plan.duration_s = sums.duration_s;
    plan.expected = expected_of(type, plan.segments);
    plan.turns += first.turns;
    plan.cost += first.cost;
    for (const std::string& id : first.closures) add_once(plan.closures, id);
    for (const std::string& id : first.loads) add_once(plan.loads, id);
    return plan;
}

namespace {

/// What most of it is; one that costs no more would only take longer.
LegAlternative::Reason main_reason(const LegAlternative& more) {
    using Reason = LegAlternative::Reason;
    if (more.more_cost <= 0) return Reason::kTime;
    if (more.more_accuracy > std::max(more.more_turns, more.more_length)) return Reason::kAccuracy;
    return more.more_turns > more.more_length ? Reason::kTurns : Reason::kLength;
}

}  // namespace

LegAlternative compared(const plant::RoutingCost& cost, const LegPlan& taken, LegPlan other) {
    const double turn = (cost.k_diff - cost.k_same) * cost.reference_step_m;
    LegAlternative more;
    more.more_cost = other.cost - taken.cost;
    more.more_turns = turn * (other.turns - taken.turns);
    more.more_accuracy = other.accuracy - taken.accuracy;
    more.more_length = more.more_cost - more.more_turns - more.more_accuracy;
    more.more_s = other.duration_s - taken.duration_s;
    more.main_reason = main_reason(more);
    more.plan = std::move(other);
    return more;
}

void describe(const plant::VehicleType& type, const Body& body, const Obstacles& obstacles,
              const std::vector<StandingBody>& standing, LegPlan& plan) {
    const auto pieces = kinematics::sweep(body.pieces, plan.segments);
    const Approach nearest = obstacles.nearest(pieces);
    plan.clearance_m = nearest.distance_m;
    plan.nearest = nearest.what;
    for (const StandingBody& other : standing) {
        const double distance = distance_to(other, pieces, plan.clearance_m);
        if (distance >= plan.clearance_m) continue;
        plan.clearance_m = distance;
        plan.nearest = other.vehicle.str();
    }
    if (!type.wheels.empty()) {
        const auto trajectory = kinematics::Trajectory::of(type, plan.segments, plan.max_speed_mps);
        if (trajectory) plan.wheels = trajectory->wheel_peaks();
    }
    plan.swept = geometry::union_outline(
        kinematics::sweep(body.pieces, plan.segments, kinematics::kOutlineDetail));
    for (const Polygon& ring : plan.swept) plan.swept_area_m2 += geometry::area_m2(ring);
}

Result<LegPlan> assess_grid(const LegTask& task, GridLegs& grid) {
    return grid.draft(task).and_then(
        [&](LegDraft draft) { return finish(task, MotionMode::kLinear, std::move(draft)); });
}

Result<LegPlan> assess_free(const LegTask& task, FreeLegs& free,
                            const std::vector<StandingBody>& standing) {
    return free.draft(task, standing).map([&](LegDraft draft) {
        // It was checked with finer sweeps than these, which would refuse what just fits.
        const auto pieces = kinematics::sweep(task.passage.body.pieces, draft.segments);
        return cleared(task, MotionMode::kFree, std::move(draft), pieces);
    });
}

Result<LegPlan> assess_mode(const LegTask& task, MotionMode mode) {
    const auto variants = kinematics::motion_variants(*task.request.type, task.request.start,
                                                      task.station.pose, mode);
    if (!variants) return fail(variants.error());
    Best best;
    for (const auto& motion : *variants) {
        if (best.offer(finish(task, mode, draft_direct(task, motion)))) return best.take();
    }
    // Why there is no way along lanes says more than why a direct one is blocked.
    if (mode == MotionMode::kLinear && !task.request.target_pose) {
        auto along_roads = draft_road_leg(task).and_then(
            [&](LegDraft draft) { return finish(task, mode, std::move(draft)); });
        if (!best.has_plan()) return along_roads;
        best.offer(std::move(along_roads));
    }
    return best.take();
}

}  // namespace pulseline::planning
