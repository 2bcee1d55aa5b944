#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/access/access.hpp"
#include "core/fleet/state/ports.hpp"
#include "db/error.hpp"

/// Stores in memory that can be told to fail, for tests of what the server does around them.
namespace pulseline::server::testing {

class MemoryStore : public fleet::Store, public fleet::History {
public:
    std::atomic<bool> fails{false};
    std::atomic<bool> is_full{false};
    std::atomic<int> commits{0};

    fleet::StoredFleet load() override {
        const std::lock_guard lock(mutex_);
        fleet::StoredFleet stored;
        for (const auto& [id, order] : orders_) {
            stored.orders.push_back(order);
            stored.last_order_number = std::max(stored.last_order_number, order.number);
        }
        for (const auto& [id, vehicle] : vehicles_) stored.vehicles.push_back(vehicle);
        stored.idempotency = idempotency_;
        for (const auto& [id, schedule] : schedules_) stored.schedules.push_back(schedule);
        for (const auto& [name, one] : templates_) stored.templates.push_back(one);
        if (!events_.empty()) {
            stored.last_event_seq = events_.back().seq;
            stored.last_time = events_.back().at;
        }
        if (!journal_.empty()) stored.last_journal_seq = journal_.back().seq;
        return stored;
    }
    fleet::StoredJournal load_journal() override {
        const std::lock_guard lock(mutex_);
        fleet::StoredJournal stored;
        stored.snapshot = snapshot_;
        for (const auto& row : journal_) {
            if (snapshot_ && row.seq > snapshot_->journal_seq) stored.rows.push_back(row);
        }
        return stored;
    }
    void put_snapshot(const fleet::SnapshotRow& snapshot) override {
        throw_if_told();
        const std::lock_guard lock(mutex_);
        snapshot_ = snapshot;
    }
    /// From now on a commit hangs until go_on().
    void hang() {
        const std::lock_guard lock(hang_mutex_);
        hangs_ = true;
    }
    void go_on() {
        const std::lock_guard lock(hang_mutex_);
        hangs_ = false;
        hang_wake_.notify_all();
    }
    void commit(const fleet::Records& records) override {
        {
            std::unique_lock lock(hang_mutex_);
            hang_wake_.wait(lock, [this] { return !hangs_; });
        }
        throw_if_told();
        const std::lock_guard lock(mutex_);
        for (const auto& row : records.journal) {
            if (row.seq != (journal_.empty() ? 0 : journal_.back().seq) + 1) {
                throw std::runtime_error("gap in the journal");
            }
            journal_.push_back(row);
        }
        for (const auto& order : records.orders) orders_[order.id] = order;
        for (const auto& vehicle : records.vehicles) vehicles_[vehicle.id] = vehicle;
        for (const auto& event : records.events) {
            if (event.seq != (events_.empty() ? 0 : events_.back().seq) + 1) {
                throw std::runtime_error("gap in the event sequence");
            }
            events_.push_back(event);
        }
        stops_.insert(stops_.end(), records.stops.begin(), records.stops.end());
        idempotency_.insert(idempotency_.end(), records.idempotency.begin(),
                            records.idempotency.end());
        for (const auto& one : records.schedules) {
            schedules_.erase(one.id);
            if (!one.deleted) schedules_[one.id] = one;
        }
        for (const auto& one : records.templates) {
            templates_.erase(one.name);
            if (!one.deleted) templates_[one.name] = one;
        }
        ++commits;
    }

    std::vector<fleet::StopRecord> stops(const fleet::StopQuery&) override {
        const std::lock_guard lock(mutex_);
        return {stops_.rbegin(), stops_.rend()};
    }
    std::optional<fleet::StopRecord> stop(fleet::StopRecordId) override { return std::nullopt; }
    std::vector<fleet::JobOrder> orders(const fleet::OrderQuery&) override {
        const std::lock_guard lock(mutex_);
        std::vector<fleet::JobOrder> all;
        for (const auto& [id, order] : orders_) all.push_back(order);
        std::ranges::reverse(all);
        return all;
    }
    std::optional<fleet::JobOrder> order(fleet::JobOrderId id) override {
        const std::lock_guard lock(mutex_);
        const auto found = orders_.find(id);
        return found == orders_.end() ? std::nullopt : std::optional(found->second);
    }
    std::vector<fleet::Event> unmeasured_stops(const fleet::UnmeasuredQuery&) override {
        return {};
    }
    std::vector<fleet::LoadMove> load_moves(const fleet::LoadMoveQuery&) override { return {}; }
    bool has_load_sheet(const plant::LoadId&) override { return false; }
    std::vector<fleet::Event> events_after(std::int64_t seq, int limit) override {
        const std::lock_guard lock(mutex_);
        std::vector<fleet::Event> page;
        for (const auto& event : events_) {
            if (event.seq > seq && page.size() < static_cast<std::size_t>(limit)) {
                page.push_back(event);
            }
        }
        return page;
    }
    fleet::StopStatistics statistics(const std::vector<plant::VehicleId>&, plant::MotionMode,
                                     int) override {
        return {};
    }
    /// What a store that keeps only the newest events leaves.
    void drop_events_before(std::int64_t seq) {
        const std::lock_guard lock(mutex_);
        std::erase_if(events_, [&](const fleet::Event& event) { return event.seq < seq; });
    }
    std::size_t order_count() {
        const std::lock_guard lock(mutex_);
        return orders_.size();
    }
    std::size_t event_count() {
        const std::lock_guard lock(mutex_);
        return events_.size();
    }

    std::vector<fleet::Event> all_events() {
        const std::lock_guard lock(mutex_);
        return events_;
    }

private:
    void throw_if_told() const {
        if (is_full) throw db::Error(db::Error::Kind::kFull, "disk full (by the test)");
        if (fails) throw std::runtime_error("disk error (by the test)");
    }

    std::mutex hang_mutex_;
    std::condition_variable hang_wake_;
    bool hangs_ = false;
    std::mutex mutex_;
    std::map<fleet::JobOrderId, fleet::JobOrder> orders_;
    std::map<plant::VehicleId, fleet::VehicleRecord> vehicles_;
    std::vector<fleet::IdempotencyRecord> idempotency_;
    std::map<fleet::ScheduleId, fleet::Schedule> schedules_;
    std::map<std::string, fleet::OrderTemplate> templates_;
    std::vector<fleet::Event> events_;
    std::vector<fleet::StopRecord> stops_;
    std::vector<fleet::JournalRow> journal_;
    std::optional<fleet::SnapshotRow> snapshot_;
};

class MemoryAccess : public access::Store {
public:
    std::vector<access::User> users() override { return users_; }
    std::vector<access::Session> sessions() override { return sessions_; }
    std::vector<access::Token> tokens() override { return tokens_; }
    void put(const access::User& user) override { users_.push_back(user); }
    void put(const access::Session& session) override { sessions_.push_back(session); }
    void put_use(const std::string&, Time) override {}
    void remove_sessions(const std::vector<std::string>&) override {}
    void put(const access::Token& token) override { tokens_.push_back(token); }

private:
    std::vector<access::User> users_;
    std::vector<access::Session> sessions_;
    std::vector<access::Token> tokens_;
};

}  // namespace pulseline::server::testing
