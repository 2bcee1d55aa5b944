#include "core/planning/legs/free_leg.hpp"

#include <algorithm>

#include "core/planning/roads/road_search.hpp"

namespace pulseline::planning {
namespace {

// The server's state machine waits meanwhile.
constexpr double kTimeLimit_s = 0.5;
constexpr std::size_t kRemembered = 32;

bool same(const StandingBody& a, const StandingBody& b) {
    return a.vehicle == b.vehicle && a.outline == b.outline;
}

bool same(const FreeManoeuvreRequest& a, const FreeManoeuvreRequest& b) {
    return a.loaded == b.loaded && a.start == b.start && a.goal == b.goal &&
           std::ranges::equal(a.standing, b.standing,
                              [](const auto& x, const auto& y) { return same(x, y); });
}

/// Changes of direction: each arc, and each turn on the spot between two ways.
int turns_of(const std::vector<kinematics::Segment>& segments) {
    using Kind = kinematics::Segment::Kind;
    int turns = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const bool last = i + 1 == segments.size();
        turns += segments[i].kind == Kind::kArc || (segments[i].kind == Kind::kRotate && !last);
    }
    return turns;
}

}  // namespace

const FreeFloor* FreeLegs::floor(const plant::HallId& id) {
    const plant::Hall* hall = plant::find_hall(plant_, id);
    if (!hall) return nullptr;
    auto& known = floors_[id];
    if (!known) known = std::make_unique<const FreeFloor>(plant_, *hall);
    return known.get();
}

Result<kinematics::MotionPlan> FreeLegs::plan(const FreeFloor& floor,
                                              const FreeManoeuvreRequest& request) {
    const auto found = std::ranges::find_if(known_, [&](const Known& known) {
        return known.hall == floor.hall && known.type.id == request.type->id &&
               body_of(known.type, request.loaded) == body_of(*request.type, request.loaded) &&
               same(known.request, request);
    });
    if (found != known_.end()) return found->motion;
    auto motion = plan_free_manoeuvre(floor, request).map([](FreeManoeuvre free) {
        return std::move(free.motion);
    });
    known_.push_front({*request.type, request, floor.hall, motion});
    if (known_.size() > kRemembered) known_.pop_back();
    return motion;
}

Result<LegDraft> FreeLegs::draft(const LegTask& task, const std::vector<StandingBody>& standing) {
    FreeManoeuvreRequest request;
    request.type = task.request.type;
    request.loaded = task.request.loaded;
    request.start = task.request.start;
    request.goal = task.station.pose;
    request.time_limit_s = kTimeLimit_s;
    request.standing = standing;
    const FreeFloor* hall = floor(task.request.hall);
    if (!hall) {
        return fail(Errc::kNotFound, "unknown_hall",
                    "There is no hall " + task.request.hall.str() + " in the plant.");
    }
    const std::size_t bodies = request.standing.size();
    for (const ClosedFloor& closed : task.closures) {
        if (closed.hall == task.request.hall)
            request.standing.push_back({plant::VehicleId(closed.id), closed.pieces});
    }
    auto motion = plan(*hall, request);
    if (!motion && request.standing.size() > bodies) {
        request.standing.resize(bodies);
        motion = plan(*hall, request);  // over closed floor, and the leg will say so
    }
    return motion.map([&](const kinematics::MotionPlan& plan) {
        LegDraft draft;
        draft.segments = plan.segments;
        draft.turns = turns_of(plan.segments);
        draft.cost = edge_cost(task.cost, plan.length_m, false) +
                     draft.turns * (edge_cost(task.cost, 0, true) - edge_cost(task.cost, 0, false));
        return draft;
    });
}

}  // namespace pulseline::planning
