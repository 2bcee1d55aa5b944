#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/planning/legs/leg_planner.hpp"

namespace pulseline::planning {

/// Legs from one station to another that were planned before: orders of many steps repeat them, and
/// who asks first may do so on another thread. What is kept is what would be planned again, so an
/// answer never depends on it. REQUIRES: requests name vehicle types that outlive the memo.
/// Thread safety: every function.
class LegMemo {
public:
    /// All closed floor in words; one text serves all legs that were planned with it.
    using Closures = std::shared_ptr<const std::string>;

    std::optional<Result<LegPlan>> find(const LegRequest& request, bool with_free,
                                        const Closures& closures) {
        const std::lock_guard lock(mutex_);
        const auto found = plans_.find(Key(request, with_free, closures));
        if (found == plans_.end() || !(found->second.request == request)) return std::nullopt;
        return found->second.plan;
    }
    void keep(const LegRequest& request, bool with_free, const Closures& closures,
              const Result<LegPlan>& plan) {
        const std::lock_guard lock(mutex_);
        const auto [kept, is_new] =
            plans_.insert_or_assign(Key(request, with_free, closures), Kept{request, plan});
        if (!is_new) return;
        oldest_.push_back(kept->first);
        if (oldest_.size() <= kMost) return;
        plans_.erase(oldest_.front());
        oldest_.pop_front();
    }

private:
    static constexpr std::size_t kMost = 4096;  // some kilobytes each

    struct Key {
        Key(const LegRequest& request, bool with_free, Closures closed)
            : leg(request.type->id.str(), request.loaded, request.from_station.str(),
                  request.target.str(), static_cast<int>(request.mode), with_free),
              closures(std::move(closed)) {}
        bool operator<(const Key& other) const {
            return leg != other.leg ? leg < other.leg : *closures < *other.closures;
        }
        std::tuple<std::string, bool, std::string, std::string, int, bool> leg;
        Closures closures;
    };
    struct Kept {
        LegRequest request;
        Result<LegPlan> plan;
    };

    std::mutex mutex_;
    std::map<Key, Kept> plans_;
    std::deque<Key> oldest_;
};

}  // namespace pulseline::planning
