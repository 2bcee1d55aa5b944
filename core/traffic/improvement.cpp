#include <algorithm>

#include "core/traffic/traffic.hpp"

// Background improvement. Every accepted step makes the finishes it touches sooner and none later
// (alone), or their sum sooner and the oldest task's not later (in pairs), so steps cannot undo
// each other for ever: the oldest task always gets done.
namespace pulseline::traffic {
namespace {

constexpr double kWorthwhile_s = 1.0;  // less is not worth a message to the vehicle
constexpr double kRetry_s = 10;  // between two searches for one vehicle; little changes sooner

}  // namespace

bool Traffic::is_resting(VehicleIndex vehicle) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    const PlaceIndex end = plan.place_after(plan.released);
    const Vehicle& v = vehicles_[vehicle];
    return end != kNoPlace && v.graph != kNoGraph && graphs_[v.graph]->places[end].resting;
}

bool Traffic::is_blocked(VehicleIndex vehicle, double now_s) const {
    return joint_.finish_s(vehicle) > now_s + kBlocked_s / 2;
}

std::size_t Traffic::count_blocked(double now_s) const {
    std::size_t count = 0;
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) count += is_blocked(v, now_s) ? 1 : 0;
    return count;
}

/// Planned finish of the task that was admitted first of those not ended; blocked ones cannot be
/// helped and do not count.
double Traffic::oldest_finish_s() const {
    double admitted_s = std::numeric_limits<double>::infinity();
    double finish_s = std::numeric_limits<double>::infinity();
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        const VehiclePlan& plan = joint_.plan(v);
        const double end_s = joint_.finish_s(v);
        if (plan.last() == plan.passed || end_s > predicted_s_ + kBlocked_s / 2) continue;
        if (vehicles_[v].admitted_s < admitted_s) {
            admitted_s = vehicles_[v].admitted_s;
            finish_s = end_s;
        }
    }
    return finish_s;
}

bool Traffic::improve_one(VehicleIndex vehicle, double now_s) {
    const VehiclePlan& plan = joint_.plan(vehicle);
    const Vehicle& v = vehicles_[vehicle];
    const SearchTask task =
        search_task(vehicle, plan.released, v.task, first_open_visit(vehicle), now_s);
    SearchResult found = search_.find(joint_, task);
    if (!found.found) {
        vehicles_[vehicle].blocked_by = block_of(found.obstacle);
        return false;
    }
    const double finish_s = found.moves.empty() ? now_s : found.moves.back().end_s;
    if (!v.postponed && finish_s > joint_.finish_s(vehicle) - kWorthwhile_s) return false;
    if (!merge_plan(vehicle, std::move(found.moves), Placement::kByTime, now_s)) return false;
    vehicles_[vehicle].blocked_by.reset();
    vehicles_[vehicle].postponed = false;
    tell_plan(vehicle);
    return true;
}

/// A blocked vehicle leaves the way it stands in; its visits wait.
bool Traffic::retreat(VehicleIndex vehicle, double now_s) {
    const VehiclePlan& plan = joint_.plan(vehicle);
    Task only_rest;
    only_rest.resting = vehicles_[vehicle].task.resting;
    const auto left = plan_from(vehicle, plan.released, only_rest, 0, now_s, false);
    if (!left) return false;
    vehicles_[vehicle].postponed =
        first_open_visit(vehicle) < vehicles_[vehicle].task.visits.size();
    tell_plan(vehicle);
    return true;
}

/// It has no plan and others wait for it to leave.
bool Traffic::in_the_way(VehicleIndex vehicle) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    return plan.last() == plan.released && !joint_.nobody_behind(vehicle);
}

/// Blocked vehicles give up what they planned behind their bases: they stand where their bases end,
/// each on floor it holds alone, so the rest stays in order. That returns the resting places and
/// gaps which they keep from each other, and whoever stands in the way can leave.
bool Traffic::untangle(double now_s) {
    std::vector<VehicleIndex> changed;
    for (bool more = true; more;) {
        // A vehicle that is stopped here no longer leaves floor that it could have left before the
        // place where it was blocked, so others can become blocked by it.
        more = false;
        predicted_ = false;
        predict(now_s);
        std::vector<VehicleIndex> blocked;
        for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
            const VehiclePlan& plan = joint_.plan(v);
            if (plan.last() > plan.released && is_blocked(v, now_s)) blocked.push_back(v);
        }
        for (const VehicleIndex v : blocked) {
            vehicles_[v].postponed = first_open_visit(v) < vehicles_[v].task.visits.size();
            merge_plan(v, {}, Placement::kByTime, now_s);
            changed.push_back(v);
            more = true;
        }
    }
    predicted_ = false;
    for (const VehicleIndex v : changed) {
        replanned_.push_back(v);
        if (report_changes_) tell(plan_change(v));
    }
    tell_touched();
    return !changed.empty();
}

/// The vehicle goes before the one it waits for, when both together gain.
bool Traffic::improve_pair(VehicleIndex vehicle, VehicleIndex before, double now_s) {
    const VehiclePlan& other = joint_.plan(before);
    if (other.halted || other.last() == other.released || vehicles_[before].postponed) return false;
    if (other.place_after(other.released) == kNoPlace || vehicles_[before].graph == kNoGraph) {
        return false;
    }
    const double old_sum_s = joint_.finish_s(vehicle) + joint_.finish_s(before);
    const double old_oldest_s = oldest_finish_s();
    Undos undos;
    const auto attempt = [&] {
        // For the search the other one stays where its base ends, for ever.
        merge_plan(before, {}, Placement::kByTime, now_s, &undos);
        predicted_ = false;
        const Task mine = vehicles_[vehicle].task;
        const VehiclePlan& plan = joint_.plan(vehicle);
        if (!plan_from(vehicle, plan.released, mine, first_open_visit(vehicle), now_s, false,
                       &undos)) {
            return false;
        }
        const Task its = vehicles_[before].task;
        if (!plan_from(before, joint_.plan(before).released, its, first_open_visit(before), now_s,
                       false, &undos)) {
            return false;
        }
        predicted_ = false;
        predict(now_s);
        return joint_.finish_s(vehicle) + joint_.finish_s(before) < old_sum_s - kWorthwhile_s &&
               oldest_finish_s() <= old_oldest_s;
    };
    if (!attempt()) {
        roll_back(undos);
        return false;
    }
    replanned_.push_back(before);
    if (report_changes_) tell(plan_change(before));
    tell_plan(vehicle);
    return true;
}

Improvement Traffic::improve(Time now, int steps) {
    const double now_s = s(now);
    if (now_s > predicted_s_) predicted_ = false;
    predict(now_s);
    struct Candidate {
        VehicleIndex vehicle;
        int urgency;  // 3 in the way, 2 blocked, 1 postponed at rest, 0 slow
        double loss_s;
    };
    std::vector<Candidate> candidates;
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        const VehiclePlan& plan = joint_.plan(v);
        if (plan.halted || vehicles_[v].gone || vehicles_[v].graph == kNoGraph) continue;
        if (now_s < vehicles_[v].tried_s + kRetry_s) continue;
        if (plan.place_after(plan.released) == kNoPlace) continue;
        if (plan.last() == plan.released && in_the_way(v)) {
            candidates.push_back({v, 3, 0});
            continue;
        }
        if (vehicles_[v].postponed) {
            candidates.push_back({v, is_resting(v) ? 1 : 2, 0});
            continue;
        }
        if (plan.last() == plan.released) continue;
        double alone_s = 0;
        for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n)
            alone_s += plan.at(n).duration_s;
        const double loss_s = joint_.finish_s(v) - now_s - alone_s;
        if (loss_s < kWorthwhile_s) continue;
        candidates.push_back({v, is_blocked(v, now_s) ? 2 : 0, loss_s});
    }
    std::sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        // Whom the last call tried comes last, so that everybody has a turn.
        const double tried_a = vehicles_[a.vehicle].tried_s;
        const double tried_b = vehicles_[b.vehicle].tried_s;
        if (a.urgency != b.urgency) return a.urgency > b.urgency;
        if (tried_a != tried_b) return tried_a < tried_b;
        return a.loss_s != b.loss_s ? a.loss_s > b.loss_s : a.vehicle < b.vehicle;
    });
    Improvement result;
    for (const Candidate& candidate : candidates) {
        if (steps-- <= 0) break;
        const VehicleIndex v = candidate.vehicle;
        vehicles_[v].tried_s = now_s;
        predict(now_s);
        const bool has_task = vehicles_[v].postponed || candidate.urgency < 3;
        bool changed = has_task && improve_one(v, now_s);
        if (!changed && candidate.urgency > 0 && vehicles_[v].makes_way_for) {
            vehicles_[v].task.resting.clear();  // where it was to go is not to be had any more
            changed = improve_one(v, now_s);
        }
        if (!changed && candidate.urgency >= 2 && !is_resting(v)) changed = retreat(v, now_s);
        if (!changed && candidate.urgency == 3 && untangle(now_s)) {
            changed = (has_task && improve_one(v, now_s)) || retreat(v, now_s);
        }
        if (!changed && candidate.urgency == 0) {
            const VehiclePlan& plan = joint_.plan(v);
            std::optional<VehicleIndex> before;
            for (MoveNumber n = plan.released + 1; n <= plan.last() && !before; ++n) {
                for (const MoveRef& ref : plan.at(n).waits_for) {
                    const VehiclePlan& other = joint_.plan(ref.vehicle);
                    const bool in_horizon = ref.move != kForever && ref.move > other.released;
                    const double ready_s = n > plan.passed + 1 ? plan.at(n - 1).end_s : now_s;
                    if (in_horizon && other.at(ref.move).end_s > ready_s + kWorthwhile_s) {
                        before = ref.vehicle;
                    }
                }
            }
            if (before && improve_pair(v, *before, now_s)) {
                changed = true;
                result.changed.push_back(*before);
            }
        }
        if (!changed && candidate.urgency > 0 && vehicles_[v].blocked_by) {
            // An idle one that was left in a lane, or stands where this one wants to go.
            const Task task = vehicles_[v].task;
            const auto plan = plan_with_others_away(v, task, first_open_visit(v), now_s);
            if (plan) {
                note_moved_aside(v, task, plan->made_way);
                result.changed.insert(result.changed.end(), plan->made_way.begin(),
                                      plan->made_way.end());
                vehicles_[v].blocked_by.reset();
                vehicles_[v].postponed = false;
                tell_plan(v);
                changed = true;
            }
        }
        if (changed) {
            result.changed.push_back(v);
        } else if (candidate.urgency > 0) {
            result.blocked.push_back(v);
        }
    }
    predict(now_s);  // a pair that gained nothing left times of its trial behind
    return result;
}

}  // namespace pulseline::traffic
