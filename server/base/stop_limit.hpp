#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace pulseline::server {

/// Once begun, ends in `over` unless it is destroyed before: a disk that hangs may hold a thread
/// for ever, but not the end of the process.
class StopLimit {
public:
    ~StopLimit() {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        wake_.notify_all();
        if (thread_.joinable()) thread_.join();
    }
    StopLimit() = default;
    StopLimit(const StopLimit&) = delete;
    StopLimit& operator=(const StopLimit&) = delete;

    /// To be called once. `over` is called on a thread of its own.
    void begin(std::chrono::milliseconds most, std::function<void()> over) {
        thread_ = std::thread([this, most, over = std::move(over)] {
            std::unique_lock lock(mutex_);
            if (!wake_.wait_for(lock, most, [this] { return ended_; })) over();
        });
    }

private:
    std::mutex mutex_;
    std::condition_variable wake_;
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace pulseline::server
