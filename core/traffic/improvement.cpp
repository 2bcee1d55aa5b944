#include <algorithm>

#include "core/traffic/traffic.hpp"

// Background improvement: whose turn it is, and what is tried for it. The steps themselves are in
// improvement_steps.cpp. Every accepted step makes the finishes it touches sooner and none later
// (alone), or their sum sooner and the oldest task's not later (in pairs), so steps cannot undo
// each other for ever: the oldest task always gets done.
namespace pulseline::traffic {
namespace {

constexpr double kRetry_s = 10;  // between two searches for one vehicle; little changes sooner

}  // namespace

/// Whom a step may help, in the order of their turns.
std::vector<Traffic::Candidate> Traffic::improvement_candidates(double now_s) const {
    std::vector<Candidate> candidates;
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        const VehiclePlan& plan = joint_.plan(v);
        if (plan.halted || vehicles_[v].gone || vehicles_[v].graph == kNoGraph) continue;
        if (now_s < vehicles_[v].tried_s + kRetry_s) continue;
        if (plan.place_after(plan.released) == kNoPlace) continue;
        if (plan.last() == plan.released && in_the_way(v)) {
            candidates.push_back({v, Urgency::kInTheWay, 0});
            continue;
        }
        if (vehicles_[v].postponed) {
            candidates.push_back({v, is_resting(v) ? Urgency::kPostponed : Urgency::kBlocked, 0});
            continue;
        }
        if (plan.last() == plan.released) continue;
        double alone_s = 0;
        for (MoveNumber n = plan.passed + 1; n <= plan.last(); ++n)
            alone_s += plan.at(n).duration_s;
        const double loss_s = joint_.finish_s(v) - now_s - alone_s;
        if (loss_s < kWorthwhile_s) continue;
        candidates.push_back(
            {v, is_blocked(v, now_s) ? Urgency::kBlocked : Urgency::kSlow, loss_s});
    }
    std::sort(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
        // Whom the last call tried comes last, so that everybody has a turn.
        const double tried_a = vehicles_[a.vehicle].tried_s;
        const double tried_b = vehicles_[b.vehicle].tried_s;
        if (a.urgency != b.urgency) return a.urgency > b.urgency;
        if (tried_a != tried_b) return tried_a < tried_b;
        return a.loss_s != b.loss_s ? a.loss_s > b.loss_s : a.vehicle < b.vehicle;
    });
    return candidates;
}

/// The first in whose horizon the vehicle loses time by waiting, which may let it go before.
std::optional<VehicleIndex> Traffic::whom_to_overtake(VehicleIndex vehicle, double now_s) const {
    const VehiclePlan& plan = joint_.plan(vehicle);
    for (MoveNumber n = plan.released + 1; n <= plan.last(); ++n) {
        const double ready_s = n > plan.passed + 1 ? plan.at(n - 1).end_s : now_s;
        std::optional<VehicleIndex> before;
        for (const MoveRef& ref : plan.at(n).waits_for) {
            const VehiclePlan& other = joint_.plan(ref.vehicle);
            const bool in_horizon = ref.move != kForever && ref.move > other.released;
            if (in_horizon && other.at(ref.move).end_s > ready_s + kWorthwhile_s) {
                before = ref.vehicle;
            }
        }
        if (before) return before;
    }
    return std::nullopt;
}

/// Tries for one candidate what helps those of its urgency, the mildest first.
bool Traffic::improve_candidate(const Candidate& candidate, double now_s, Improvement& result) {
    const VehicleIndex v = candidate.vehicle;
    const Urgency urgency = candidate.urgency;
    const bool has_task = vehicles_[v].postponed || urgency < Urgency::kInTheWay;
    if (has_task && improve_one(v, now_s)) return true;
    if (urgency == Urgency::kSlow) {
        const auto before = whom_to_overtake(v, now_s);
        if (!before || !improve_pair(v, *before, now_s)) return false;
        result.changed.push_back(*before);
        return true;
    }
    if (vehicles_[v].makes_way_for) {
        vehicles_[v].task.resting.clear();  // where it was to go is not to be had any more
        if (improve_one(v, now_s)) return true;
    }
    if (urgency >= Urgency::kBlocked && !is_resting(v) && retreat(v, now_s)) return true;
    if (urgency == Urgency::kInTheWay && untangle(now_s)) {
        if ((has_task && improve_one(v, now_s)) || retreat(v, now_s)) return true;
    }
    return move_idle_away(v, now_s, result);
}

Improvement Traffic::improve(Time now, int steps) {
    const double now_s = s(now);
    if (now_s > predicted_s_) predicted_ = false;
    predict(now_s);
    Improvement result;
    for (const Candidate& candidate : improvement_candidates(now_s)) {
        if (steps-- <= 0) break;
        vehicles_[candidate.vehicle].tried_s = now_s;
        predict(now_s);
        if (improve_candidate(candidate, now_s, result)) {
            result.changed.push_back(candidate.vehicle);
        } else if (candidate.urgency != Urgency::kSlow) {
            result.blocked.push_back(candidate.vehicle);
        }
    }
    predict(now_s);  // a pair that gained nothing left times of its trial behind
    return result;
}

}  // namespace pulseline::traffic
