#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>

#include "core/planning/leg_planner.hpp"

namespace pulseline::planning {

/// Legs from one station to another that were planned before: orders of many steps repeat them, and
/// who asks first may do so on another thread. What is kept is what would be planned again, so an
/// answer never depends on it. Thread safety: every function.
class LegMemo {
public:
    /// `closures`: names the closed floor it was planned with.
    std::optional<Result<LegPlan>> find(const LegRequest& request, const std::string& closures) {
        const std::lock_guard lock(mutex_);
        const auto found = plans_.find(key(request, closures));
        if (found == plans_.end() || !(found->second.request == request)) return std::nullopt;
        return found->second.plan;
    }
    void keep(const LegRequest& request, const std::string& closures, const Result<LegPlan>& plan) {
        const std::lock_guard lock(mutex_);
        const Key name = key(request, closures);
        if (!plans_.insert_or_assign(name, Kept{request, plan}).second) return;
        oldest_.push_back(name);
        if (oldest_.size() <= kMost) return;
        plans_.erase(oldest_.front());
        oldest_.pop_front();
    }

private:
    static constexpr std::size_t kMost = 4096;  // some kilobytes each

    using Key = std::tuple<std::string, bool, std::string, std::string, int, std::string>;
    struct Kept {
        LegRequest request;
        Result<LegPlan> plan;
    };
    static Key key(const LegRequest& request, const std::string& closures) {
        return {request.type->id.str(),         request.loaded,
                request.from_station.str(),     request.target.str(),
                static_cast<int>(request.mode), closures};
    }

    std::mutex mutex_;
    std::map<Key, Kept> plans_;
    std::deque<Key> oldest_;
};

}  // namespace pulseline::planning
