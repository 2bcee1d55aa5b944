#include "tests/tools/load/machine_watch.hpp"

#include <pthread.h>
#include <sched.h>

namespace pulseline::load {
namespace {

constexpr auto kSleep = std::chrono::milliseconds(2);
// Later than the work of the kernel itself makes it, by far less than a figure to hold.
constexpr auto kLate = std::chrono::milliseconds(10);

bool come_before_all(int processor) {
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(processor, &only);
    sched_param first{};
    first.sched_priority = sched_get_priority_max(SCHED_FIFO);
    return pthread_setaffinity_np(pthread_self(), sizeof only, &only) == 0 &&
           pthread_setschedparam(pthread_self(), SCHED_FIFO, &first) == 0;
}

}  // namespace

MachineWatch::MachineWatch() : gaps_(std::max(1u, std::thread::hardware_concurrency())) {
    for (int i = 0; auto& gaps : gaps_) {
        gaps.thread = std::thread([this, &gaps, processor = i++] { watch(processor, gaps); });
    }
}

MachineWatch::~MachineWatch() {
    on_ = false;
    for (auto& gaps : gaps_) gaps.thread.join();
}

void MachineWatch::watch(int processor, Gaps& gaps) {
    if (!come_before_all(processor)) return;
    gaps.watched = true;
    while (on_) {
        const auto due = Clock::now() + kSleep;
        std::this_thread::sleep_until(due);
        const auto now = Clock::now();
        if (now - due < kLate) continue;
        const double late_ms = ms_since(due);
        ++gaps.n;
        gaps.sum_ms = gaps.sum_ms + late_ms;
        gaps.max_ms = std::max(gaps.max_ms.load(), late_ms);
        auto newest = newest_end_.load();
        while (newest < now.time_since_epoch().count() &&
               !newest_end_.compare_exchange_weak(newest, now.time_since_epoch().count())) {
        }
    }
}

nlohmann::json MachineWatch::summary() const {
    bool watched = true;
    int n = 0;
    double sum_ms = 0, max_ms = 0;
    for (const auto& gaps : gaps_) {
        watched = watched && gaps.watched;
        n += gaps.n;
        sum_ms += gaps.sum_ms;
        max_ms = std::max(max_ms, gaps.max_ms.load());
    }
    return {{"watched", watched}, {"n", n}, {"sum_ms", sum_ms}, {"max_ms", max_ms}};
}

}  // namespace pulseline::load
