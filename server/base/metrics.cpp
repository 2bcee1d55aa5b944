#include "server/base/metrics.hpp"

#include <malloc.h>

namespace pulseline::server {
namespace {

/// To count a heap that is full of holes takes milliseconds, and whoever may look may ask often.
constexpr auto kHeapEvery = std::chrono::seconds(1);

}  // namespace

void Histogram::observe(double value_s) {
    std::size_t slot = 0;
    while (slot < kBounds_s.size() && value_s > kBounds_s[slot]) ++slot;
    ++counts_[slot];
    ++count_;
    sum_s_ += value_s;
}

void Metrics::request(std::string_view route, int status, double duration_s) {
    const std::lock_guard lock(mutex_);
    ++requests_[{std::string(route), status}];
    auto found = request_latency_.find(route);
    if (found == request_latency_.end()) {
        found = request_latency_.emplace(std::string(route), Histogram{}).first;
    }
    found->second.observe(duration_s);
}

void Metrics::fleet_batch(double duration_s) {
    const std::lock_guard lock(mutex_);
    fleet_batch_.observe(duration_s);
}

void Metrics::commit(double duration_s, std::size_t batches) {
    const std::lock_guard lock(mutex_);
    ++commits_;
    batches_ += batches;
    commit_latency_.observe(duration_s);
}

void Metrics::release_decided(double since_s) {
    const std::lock_guard lock(mutex_);
    release_decided_.observe(since_s);
}

void Metrics::release_stored(double since_s) {
    const std::lock_guard lock(mutex_);
    release_stored_.observe(since_s);
}

void Metrics::snapshot_taken(double duration_s) {
    const std::lock_guard lock(mutex_);
    snapshot_pause_.observe(duration_s);
}

void Metrics::snapshot(double duration_s, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    snapshot_latency_.observe(duration_s);
    snapshot_bytes_ = bytes;
}

std::size_t Metrics::heap_bytes() const {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (!heap_asked_ || now - *heap_asked_ >= kHeapEvery) {
        const auto heap = mallinfo2();
        heap_bytes_ = heap.uordblks + heap.hblkhd;
        heap_asked_ = now;
    }
    return heap_bytes_;
}

}  // namespace pulseline::server
