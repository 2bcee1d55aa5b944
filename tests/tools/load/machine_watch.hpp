#pragma once

#include <atomic>
#include <deque>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/tools/load/figures.hpp"

namespace pulseline::load {

/// Tells when the machine itself stood still. A processor that others use too is gone for a tenth
/// of a second now and then, and no server answers meanwhile. On each processor a thread that
/// comes before all others sleeps for a moment; when it wakes late, the processor was not there.
/// Without the right to come before all others (root) it watches nothing and says so.
class MachineWatch {
public:
    MachineWatch();
    ~MachineWatch();
    MachineWatch(const MachineWatch&) = delete;
    MachineWatch& operator=(const MachineWatch&) = delete;

    /// Whether a processor was gone at any moment since `begin`.
    bool stood_still_since(Clock::time_point begin) const {
        return begin.time_since_epoch().count() < newest_end_.load();
    }
    /// {"watched": bool, "n", "sum_ms", "max_ms"}
    nlohmann::json summary() const;

private:
    struct Gaps {
        std::atomic<int> n = 0;
        std::atomic<double> sum_ms = 0, max_ms = 0;
        std::atomic<bool> watched = false;
        std::thread thread;
    };
    void watch(int processor, Gaps& gaps);

    std::atomic<bool> on_ = true;
    std::atomic<Clock::rep> newest_end_ = 0;
    std::deque<Gaps> gaps_;  // of each processor
};

}  // namespace pulseline::load
