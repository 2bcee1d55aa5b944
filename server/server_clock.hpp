#pragma once

#include <chrono>

#include "core/base/time.hpp"

namespace pulseline::server {

/// The steady clock, offset once to UTC so that it never precedes the last stored time.
class ServerClock : public Clock {
public:
    explicit ServerClock(Time last_stored) {
        const Time utc{std::chrono::duration_cast<Duration>(
            std::chrono::system_clock::now().time_since_epoch())};
        offset_ = std::max(utc, last_stored) - steady();
    }
    Time now() const override { return steady() + offset_; }

private:
    static Time steady() {
        return Time{std::chrono::duration_cast<Duration>(
            std::chrono::steady_clock::now().time_since_epoch())};
    }
    Duration offset_{};
};

}  // namespace pulseline::server
