#include "core/traffic/traffic.hpp"

// The steps of background improvement: a better plan for one vehicle, an overtaking, a retreat from
// the way, and the untangling of all that are blocked. Who has its turn is in improvement.cpp.
namespace pulseline::traffic {

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
            merge_plan(v, {}, Placement::kByTime, now_s);
            // On its way to rest, too, it goes on from there as soon as there is a way.
            const bool has_visits = first_open_visit(v) < vehicles_[v].task.visits.size();
            vehicles_[v].postponed = has_visits || !is_resting(v);
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

/// An idle one that was left in a lane, or stands where this one wants to go, is sent away.
bool Traffic::move_idle_away(VehicleIndex vehicle, double now_s, Improvement& result) {
    if (!vehicles_[vehicle].blocked_by) return false;
    const Task task = vehicles_[vehicle].task;
    const auto plan = plan_with_others_away(vehicle, task, first_open_visit(vehicle), now_s);
    if (!plan) return false;
    note_moved_aside(vehicle, task, plan->made_way);
    result.changed.insert(result.changed.end(), plan->made_way.begin(), plan->made_way.end());
    vehicles_[vehicle].blocked_by.reset();
    vehicles_[vehicle].postponed = false;
    tell_plan(vehicle);
    return true;
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

}  // namespace pulseline::traffic
