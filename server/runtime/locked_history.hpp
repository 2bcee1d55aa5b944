#pragma once

#include <mutex>

#include "core/fleet/state/ports.hpp"

namespace pulseline::server {

/// The history for several threads: its one connection is used by one of them at a time.
class LockedHistory : public fleet::History {
public:
    explicit LockedHistory(fleet::History& history) : history_(history) {}

    std::vector<fleet::StopRecord> stops(const fleet::StopQuery& query) override {
        const std::lock_guard lock(mutex_);
        return history_.stops(query);
    }
    std::optional<fleet::StopRecord> stop(fleet::StopRecordId id) override {
        const std::lock_guard lock(mutex_);
        return history_.stop(id);
    }
    std::vector<fleet::Event> unmeasured_stops(const fleet::UnmeasuredQuery& query) override {
        const std::lock_guard lock(mutex_);
        return history_.unmeasured_stops(query);
    }
    std::vector<fleet::LoadMove> load_moves(const fleet::LoadMoveQuery& query) override {
        const std::lock_guard lock(mutex_);
        return history_.load_moves(query);
    }
    bool has_load_sheet(const plant::LoadId& id) override {
        const std::lock_guard lock(mutex_);
        return history_.has_load_sheet(id);
    }
    std::vector<fleet::JobOrder> orders(const fleet::OrderQuery& query) override {
        const std::lock_guard lock(mutex_);
        return history_.orders(query);
    }
    std::optional<fleet::JobOrder> order(fleet::JobOrderId id) override {
        const std::lock_guard lock(mutex_);
        return history_.order(id);
    }
    std::vector<fleet::Event> events_after(std::int64_t seq, int limit) override {
        const std::lock_guard lock(mutex_);
        return history_.events_after(seq, limit);
    }
    fleet::StopStatistics statistics(const std::vector<plant::VehicleId>& vehicles,
                                     plant::MotionMode mode, int newest) override {
        const std::lock_guard lock(mutex_);
        return history_.statistics(vehicles, mode, newest);
    }

private:
    std::mutex mutex_;
    fleet::History& history_;
};

}  // namespace pulseline::server
