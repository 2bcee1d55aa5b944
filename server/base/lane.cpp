#include "server/base/lane.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace pulseline::server {

Lane::Lane(Limits limits) : limits_(limits), thread_([this] { loop(); }) {}

Lane::~Lane() {
    stop();
    thread_.join();
}

Lane::Taken Lane::take(const std::string& whose, Job job) {
    {
        const std::lock_guard lock(mutex_);
        if (stopped_) return Taken::kStopped;
        if (queue_.size() >= limits_.waiting) return Taken::kFull;
        const auto held = held_.find(whose);
        if (held != held_.end() && held->second >= limits_.of_one) return Taken::kShareIsUsed;
        ++held_[whose];
        queue_.push_back({whose, std::move(job)});
    }
    wake_.notify_one();
    return Taken::kYes;
}

void Lane::stop() {
    std::deque<Waiting> given_up;
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        given_up.swap(queue_);
        held_.clear();
    }
    wake_.notify_one();
    for (auto& waiting : given_up) waiting.job(false);
}

double Lane::fullness() const {
    const std::lock_guard lock(mutex_);
    return static_cast<double>(queue_.size()) / static_cast<double>(limits_.waiting);
}

void Lane::loop() {
    // On Linux the niceness is the thread's own.
    if (limits_.nice != 0) {
        setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), limits_.nice);
    }
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return stopped_ || !queue_.empty(); });
        if (stopped_) return;
        Waiting next = std::move(queue_.front());
        queue_.pop_front();
        lock.unlock();
        next.job(true);
        next.job = nullptr;  // what it holds is let go without the lock
        lock.lock();
        const auto held = held_.find(next.whose);
        if (held != held_.end() && --held->second == 0) held_.erase(held);
    }
}

}  // namespace pulseline::server
