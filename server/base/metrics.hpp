#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/fleet/state/views.hpp"

namespace pulseline::server {

/// Cumulative histogram over fixed bounds.
class Histogram {
public:
    static constexpr std::array<double, 11> kBounds_s = {0.0005, 0.001, 0.0025, 0.005, 0.01, 0.025,
                                                         0.05,   0.1,   0.25,   1.0,   5.0};
    void observe(double value_s);
    void write(std::string& out, std::string_view name, std::string_view labels) const;

private:
    std::array<std::uint64_t, kBounds_s.size() + 1> counts_{};
    double sum_s_ = 0;
    std::uint64_t count_ = 0;
};

/// What waits for the fleet and behind it.
struct QueueLengths {
    std::size_t commands = 0;
    std::size_t reads = 0;
    std::size_t commits = 0;
    double tick_age_s = 0;
};

/// What the process counts about itself. Thread safety: all functions.
class Metrics {
public:
    void request(std::string_view route, int status, double duration_s);
    void commit(double duration_s, std::size_t batches);
    /// The fleet waited for its snapshot for so long.
    void snapshot_taken(double duration_s);
    void snapshot(double duration_s, std::size_t bytes);
    /// The fleet thread was busy with a batch for so long.
    void fleet_batch(double duration_s);
    void commit_failed() { ++commits_failed_; }
    /// Floor was released by a batch: since its first task was asked.
    void release_decided(double since_s);
    /// And is stored, so that the vehicles are told.
    void release_stored(double since_s);

    std::atomic<std::int64_t> connections{0};
    std::atomic<std::int64_t> stream_clients{0};
    std::atomic<std::int64_t> event_clients{0};
    std::atomic<std::int64_t> vehicle_sockets{0};
    std::atomic<std::int64_t> event_seq{0};
    std::atomic<std::uint64_t> connections_refused{0};
    std::atomic<std::uint64_t> slow_readers_closed{0};
    std::atomic<std::uint64_t> poses_skipped{0};
    std::atomic<std::uint64_t> vehicle_messages_in{0};
    std::atomic<std::uint64_t> vehicle_messages_out{0};
    std::atomic<std::uint64_t> vehicle_messages_malformed{0};
    std::atomic<std::uint64_t> vehicle_messages_withheld{0};
    std::atomic<std::int64_t> clock_ahead_ms{0};
    std::atomic<std::uint64_t> vehicle_takeovers{0};
    std::atomic<std::uint64_t> fleet_rebuilds{0};
    std::atomic<std::uint64_t> fleet_faults{0};
    std::atomic<int> read_only{0};

    /// Prometheus text format 0.0.4.
    std::string text(const std::map<std::string, int>& orders_by_state,
                     const std::map<std::string, int>& vehicles_by_link,
                     const QueueLengths& queues) const;

private:
    std::size_t heap_bytes() const;
    void write_timings(std::string& out) const;
    void write_store(std::string& out) const;
    void write_links(std::string& out) const;

    mutable std::mutex mutex_;
    mutable std::size_t heap_bytes_ = 0;
    mutable std::optional<std::chrono::steady_clock::time_point> heap_asked_;
    std::map<std::pair<std::string, int>, std::uint64_t> requests_;
    std::map<std::string, Histogram, std::less<>> request_latency_;
    Histogram fleet_batch_;
    Histogram commit_latency_;
    Histogram release_decided_;
    Histogram release_stored_;
    Histogram snapshot_pause_;
    Histogram snapshot_latency_;
    std::size_t snapshot_bytes_ = 0;
    std::uint64_t commits_ = 0;
    std::uint64_t batches_ = 0;
    std::atomic<std::uint64_t> commits_failed_{0};
};

}  // namespace pulseline::server
