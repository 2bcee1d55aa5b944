#include "server/base/log_queue.hpp"

#include <unistd.h>

#include <cerrno>
#include <thread>
#include <utility>

#include "server/base/log.hpp"

namespace pulseline::server::log {
namespace {

/// What cannot be written is lost: there is nobody to tell.
void write_whole(int descriptor, const std::string& line) {
    std::size_t done = 0;
    while (done < line.size()) {
        const auto n = ::write(descriptor, line.data() + done, line.size() - done);
        if (n < 0 && errno != EINTR) return;
        if (n > 0) done += static_cast<std::size_t>(n);
    }
}

}  // namespace

LogQueue::LogQueue(int descriptor, std::size_t most_bytes)
    : descriptor_(descriptor), most_bytes_(most_bytes) {
    std::thread([this] { write_all(); }).detach();
}

void LogQueue::push(std::string line) {
    {
        const std::lock_guard lock(mutex_);
        bytes_ += line.size();
        lines_.push_back(std::move(line));
        while (bytes_ > most_bytes_ && lines_.size() > 1) {
            bytes_ -= lines_.front().size();
            lines_.pop_front();
            ++dropped_;
        }
    }
    wake_.notify_one();
}

bool LogQueue::flush(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    return written_.wait_for(lock, most, [this] { return lines_.empty() && !writing_; });
}

std::uint64_t LogQueue::dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
}

void LogQueue::write_all() {
    for (;;) {
        std::string line;
        std::uint64_t lost = 0;
        {
            std::unique_lock lock(mutex_);
            wake_.wait(lock, [this] { return !lines_.empty(); });
            // One at a time: while it hangs in a write, all but that one can still be dropped.
            line = std::move(lines_.front());
            lines_.pop_front();
            bytes_ -= line.size();
            writing_ = true;
            lost = dropped_ - std::exchange(told_, dropped_);
        }
        if (lost > 0) {
            write_whole(descriptor_, whole_line(Level::kWarn, "log_lines_dropped",
                                                {{"lines", std::to_string(lost)}}));
        }
        write_whole(descriptor_, line);
        {
            const std::lock_guard lock(mutex_);
            writing_ = false;
        }
        written_.notify_all();
    }
}

}  // namespace pulseline::server::log
