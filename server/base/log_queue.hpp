#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

namespace pulseline::server::log {

/// Lines on their way to a file descriptor whose reader may have stopped reading: who logs never
/// waits. When too many gather the oldest are dropped, and a line says how many.
/// Thread safety: every function. It is never destroyed: its thread may hang in a write.
class LogQueue {
public:
    explicit LogQueue(int descriptor, std::size_t most_bytes = std::size_t{4} << 20);
    LogQueue(const LogQueue&) = delete;
    LogQueue& operator=(const LogQueue&) = delete;
    ~LogQueue() = delete;

    void push(std::string line);
    /// Waits until all of it is written, `most` at the longest; false: it is not.
    bool flush(std::chrono::milliseconds most);
    /// Lines that nobody will read, since the start.
    std::uint64_t dropped() const;

private:
    void write_all();

    const int descriptor_;
    const std::size_t most_bytes_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable written_;
    std::deque<std::string> lines_;
    std::size_t bytes_ = 0;
    bool writing_ = false;
    std::uint64_t dropped_ = 0;
    std::uint64_t told_ = 0;  // of those dropped
};

}  // namespace pulseline::server::log
