#include <algorithm>

#include "core/traffic/joint_plan.hpp"

// Earliest times of all moves along the precedence graph: all of them in one pass, or those before
// one vehicle's last by depth-first search over what each move waits for; a move met again while it
// is still open closes a cycle. The times are a quality
// matter only: they choose gaps and show expected finishes. Safety and order never read them.
namespace pulseline::traffic {
namespace {

constexpr double kLeast_s = 1e-3;  // every move lasts, so that times order the moves
constexpr double kRounding_s = 1e-6;

}  // namespace

void JointPlan::set_times(VehicleIndex vehicle, MoveNumber n, double now_s) {
    VehiclePlan& plan = vehicles_[vehicle];
    PlannedMove& move = plan.at(n);
    const bool under_way = n == plan.passed + 1 && n <= plan.released;
    double start_s = n == plan.passed + 1 ? plan.since_s : plan.at(n - 1).end_s;
    if (n > plan.released) {
        start_s = std::max(start_s, now_s);
        if (closed_tile(plan.stand_after(n - 1), *move.shape)) start_s += kBlocked_s;
    }
    for (const MoveRef& other : move.waits_for) {
        const VehiclePlan& before = vehicles_[other.vehicle];
        if (other.move == kForever) {
            start_s = std::max(start_s, now_s + kBlocked_s);
        } else if (other.move > before.passed) {
            start_s = std::max(start_s, before.at(other.move).end_s);
        }
    }
    double end_s = start_s + std::max(move.duration_s, kLeast_s);
    if (under_way && end_s < now_s + kLeast_s) {
        // What is late for a minute is expected to need another minute.
        end_s = now_s + std::max(now_s - end_s, kLeast_s);
    }
    if (plan.halted && n == plan.passed + 1) end_s = std::max(end_s, now_s) + kBlocked_s;
    move.start_s = start_s;
    move.end_s = end_s;
}

/// Sets the move's times when all it waits for has been set, else stacks what is missing. False:
/// something missing is already open, which is a cycle.
bool JointPlan::work_out(MoveRef ref, double now_s, std::vector<MoveRef>& stack) {
    VehiclePlan& plan = vehicles_[ref.vehicle];
    PlannedMove& move = plan.at(ref.move);
    if (move.stamp == stamp_ && !move.open) {
        stack.pop_back();
        return true;
    }
    move.stamp = stamp_;
    move.open = true;
    const std::size_t before = stack.size();
    bool cycle = false;
    const auto need = [&](MoveRef other) {
        const VehiclePlan& its = vehicles_[other.vehicle];
        if (other.move == kForever || other.move <= its.passed) return;
        const PlannedMove& earlier = its.at(other.move);
        if (earlier.stamp != stamp_) {
            stack.push_back(other);
        } else if (earlier.open) {
            cycle = true;
        }
    };
    if (ref.move > plan.passed + 1) need({ref.vehicle, ref.move - 1});
    for (const MoveRef& other : move.waits_for) need(other);
    if (cycle) return false;
    if (stack.size() > before) return true;
    set_times(ref.vehicle, ref.move, now_s);
    move.open = false;
    stack.pop_back();
    return true;
}

bool JointPlan::reach(MoveRef root, double now_s) {
    std::vector<MoveRef> stack{root};
    while (!stack.empty()) {
        if (!work_out(stack.back(), now_s, stack)) return false;
    }
    return true;
}

/// Every vehicle's moves in turn, as far as all they wait for is known; who has to wait is called
/// again when the other one gets there. Nobody left to call and moves left over: a cycle.
bool JointPlan::predict(double now_s) {
    struct Waiter {
        VehicleIndex vehicle;
        MoveNumber move;  // that has to be known
    };
    std::vector<MoveNumber> known(vehicles_.size());
    std::vector<std::vector<Waiter>> waiters(vehicles_.size());
    std::vector<VehicleIndex> ready(vehicles_.size());
    std::size_t left = 0;
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        known[v] = vehicles_[v].passed;
        left += vehicles_[v].last() - vehicles_[v].passed;
        ready[vehicles_.size() - 1 - v] = v;
    }
    const auto unknown = [&](const MoveRef& ref) {
        return ref.move != kForever && ref.move > known[ref.vehicle];
    };
    while (!ready.empty()) {
        const VehicleIndex v = ready.back();
        ready.pop_back();
        const VehiclePlan& plan = vehicles_[v];
        for (MoveNumber n = known[v] + 1; n <= plan.last(); ++n) {
            const auto& waits = plan.at(n).waits_for;
            const auto wait = std::find_if(waits.begin(), waits.end(), unknown);
            if (wait != waits.end()) {
                waiters[wait->vehicle].push_back({v, wait->move});
                break;
            }
            set_times(v, n, now_s);
            known[v] = n;
            --left;
        }
        std::erase_if(waiters[v], [&](const Waiter& waiter) {
            if (waiter.move > known[v]) return false;
            ready.push_back(waiter.vehicle);
            return true;
        });
    }
    return left == 0;
}

bool JointPlan::predict_before(VehicleIndex vehicle, double now_s) {
    const VehiclePlan& plan = vehicles_[vehicle];
    if (plan.last() == plan.passed) return true;
    ++stamp_;
    return reach({vehicle, plan.last()}, now_s);
}

bool JointPlan::times_agree(const Undo& undo) const {
    const auto agree = [&](MoveRef ref) {
        const PlannedMove& move = vehicles_[ref.vehicle].at(ref.move);
        return std::all_of(move.waits_for.begin(), move.waits_for.end(), [&](const MoveRef& other) {
            const VehiclePlan& before = vehicles_[other.vehicle];
            if (other.move == kForever) return true;  // nothing follows from a stand
            return other.move <= before.passed ||
                   before.at(other.move).end_s <= move.start_s + kRounding_s;
        });
    };
    const VehiclePlan& plan = vehicles_[undo.vehicle];
    for (MoveNumber n = plan.released + 1; n <= plan.last(); ++n) {
        if (n > plan.passed + 1 && plan.at(n - 1).end_s > plan.at(n).start_s + kRounding_s) {
            return false;
        }
        if (!agree({undo.vehicle, n})) return false;
    }
    return std::all_of(touched_moves_.begin(), touched_moves_.end(), agree);
}

}  // namespace pulseline::traffic
