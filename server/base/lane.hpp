#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace pulseline::server {

/// One thread with a bounded queue in which nobody holds more than a share: what one caller asks
/// for cannot make the others wait without end.
/// Thread safety: full, but for stop(), which one thread calls.
class Lane {
public:
    struct Limits {
        std::size_t waiting = 64;
        std::size_t of_one = 16;  // waiting or running
        int nice = 0;             // of its thread
    };
    enum class Taken { kYes, kFull, kShareIsUsed, kStopped };
    /// `run` false: the lane has stopped, the job is given up.
    using Job = std::function<void(bool run)>;

    explicit Lane(Limits limits);
    ~Lane();
    Lane(const Lane&) = delete;
    Lane& operator=(const Lane&) = delete;

    /// A job that is not taken is not called.
    Taken take(const std::string& whose, Job job);
    /// Gives up what waits, at once. What runs ends by itself; the destructor waits for it.
    void stop();
    /// How much of the queue is taken, from 0 to 1.
    double fullness() const;

private:
    struct Waiting {
        std::string whose;
        Job job;
    };
    void loop();

    Limits limits_;
    mutable std::mutex mutex_;  // guards what follows
    std::condition_variable wake_;
    std::deque<Waiting> queue_;
    std::map<std::string, std::size_t> held_;
    bool stopped_ = false;
    std::thread thread_;
};

}  // namespace pulseline::server
