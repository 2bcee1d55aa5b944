#pragma once

#include <functional>
#include <mutex>
#include <optional>

#include "core/base/time.hpp"

namespace pulseline::server {

/// Core time: never goes back while the server runs, and follows UTC. At start it is UTC, unless
/// the newest stored time is a little later. When that is much later, a clock once was ahead, or
/// this one is behind; UTC is taken when it can be true, and the fleet takes back what it stored
/// (StoredFleet::last_time). Later differences are made up slowly, a tenth faster or slower,
/// because silence is counted in core time; a UTC that cannot be true is not followed at all.
/// Thread safety: full.
class ServerClock : public Clock {
public:
    using Source = std::function<Time()>;

    /// What a stored time may be ahead of UTC before UTC is believed instead.
    static constexpr Duration kTolerated = std::chrono::minutes(5);
    /// A difference that people should know of.
    static constexpr Duration kWorthTelling = std::chrono::seconds(10);

    explicit ServerClock(Time last_stored);
    ServerClock(Time last_stored, Source utc, Source steady);

    Time now() const override;
    /// To be called about once a second: compares with UTC and sets the rate.
    void follow();
    /// How far core time is ahead of UTC, as follow() saw it last.
    Duration ahead() const;
    /// Time of the build: no clock that is right is behind it.
    static Time built();

private:
    Time now_at(Time steady) const;

    Source utc_;
    Source steady_;
    mutable std::mutex mutex_;  // guards what follows
    Time begin_;                // core time at begin_steady_
    Time begin_steady_;
    int per_mille_ = 1000;  // of the steady clock's speed
    Duration ahead_{};
};

/// When people are told of a difference between core time and UTC, and when again: not each second
/// while it is made up or a clock stands still.
class ClockWatch {
public:
    enum class News { kNone, kDiffers, kAgrees };
    News look(Duration ahead);
    /// What `look` said last did not arrive: it says so again.
    void not_told() { told_.reset(); }

private:
    std::optional<Duration> told_ = Duration::zero();  // none: nobody knows what they were told
};

}  // namespace pulseline::server
