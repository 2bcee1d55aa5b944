#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace pulseline::load {

using Clock = std::chrono::steady_clock;

inline double ms_since(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Milliseconds in steps of a half, up to a minute.
class Histogram {
public:
    void add(double ms) {
        const double last = static_cast<double>(counts_.size() - 1);
        ++counts_[static_cast<std::size_t>(std::clamp(ms * 2, 0.0, last))];
        ++n_;
        most_ms_ = std::max(most_ms_, ms);
    }
    nlohmann::json summary() const {
        return {{"n", n_}, {"p50_ms", at(0.5)}, {"p99_ms", at(0.99)}, {"max_ms", most_ms_}};
    }

private:
    double at(double share) const {
        std::uint64_t below = 0;
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            below += counts_[i];
            if (n_ > 0 && static_cast<double>(below) >= share * static_cast<double>(n_)) {
                return (static_cast<double>(i) + 1) / 2;
            }
        }
        return 0;
    }
    std::vector<std::uint32_t> counts_ = std::vector<std::uint32_t>(120'000);
    std::uint64_t n_ = 0;
    double most_ms_ = 0;
};

/// All times, which are what is held, and beside them those during which the machine was there.
struct Times {
    Histogram all;
    Histogram machine_there;
    void add(double ms, bool stood_still) {
        all.add(ms);
        if (!stood_still) machine_there.add(ms);
    }
    nlohmann::json summary() const {
        auto both = all.summary();
        both["machine_there"] = machine_there.summary();
        return both;
    }
};

/// What programs that ask have seen.
struct AskTotals {
    Times answers;
    Times accepted;
    std::map<int, int> statuses;
    std::map<int, std::string> refusals;  // the first of each status, for whoever reads the figures
    std::uint64_t not_asked = 0;          // every connection waited
    int cut = 0;
};

/// What vehicles and dashboards have seen.
struct Totals {
    Times to_dashboard;
    std::uint64_t states = 0, frames = 0, events = 0, events_lost = 0;
    std::set<std::string> vehicles_lost;
    int vehicles_cut = 0, dashboards_cut = 0;
};

}  // namespace pulseline::load
