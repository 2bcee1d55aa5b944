#include <algorithm>

#include "core/traffic/joint_plan.hpp"

namespace pulseline::traffic {

std::vector<std::vector<std::int64_t>> JointPlan::ranks() const {
    std::vector<std::vector<std::int64_t>> ranks(vehicles_.size());
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        ranks[v].assign(vehicles_[v].last() - vehicles_[v].passed, -1);
    }
    // Depth first over what each move waits for; a move gets its rank when all before it have one.
    std::int64_t next = 0;
    std::vector<MoveRef> stack;
    const auto rank_of = [&](const MoveRef& ref) -> std::int64_t& {
        return ranks[ref.vehicle][ref.move - vehicles_[ref.vehicle].passed - 1];
    };
    for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
        if (!ranks[v].empty()) stack.push_back({v, vehicles_[v].last()});
        while (!stack.empty()) {
            const MoveRef ref = stack.back();
            if (rank_of(ref) >= 0) {
                stack.pop_back();
                continue;
            }
            const std::size_t before = stack.size();
            const auto need = [&](const MoveRef& other) {
                if (other.move == kForever || other.move <= vehicles_[other.vehicle].passed) return;
                if (rank_of(other) < 0) stack.push_back(other);
            };
            if (ref.move > vehicles_[ref.vehicle].passed + 1) need({ref.vehicle, ref.move - 1});
            for (const MoveRef& other : vehicles_[ref.vehicle].at(ref.move).waits_for) need(other);
            if (stack.size() > before) continue;
            rank_of(ref) = next++;
            stack.pop_back();
        }
    }
    return ranks;
}

}  // namespace pulseline::traffic
