#pragma once

#include <chrono>
#include <cstdint>

namespace pulseline {

/// The time of the core: nanoseconds of the server's steady clock, offset at start to UTC so that
/// it never precedes the last stored value. It never jumps back; the API shows it as UTC.
struct CoreClock {
    using duration = std::chrono::nanoseconds;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<CoreClock, duration>;
    static constexpr bool is_steady = true;
};
using Time = CoreClock::time_point;
using Duration = CoreClock::duration;

/// Port: the only way anything in core or server asks for the time.
class Clock {
public:
    virtual ~Clock() = default;
    virtual Time now() const = 0;
};

constexpr std::int64_t to_ns(Time t) { return t.time_since_epoch().count(); }
constexpr Time time_from_ns(std::int64_t ns) { return Time{Duration{ns}}; }
constexpr double seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
/// No span of the core is longer: what divides by a tiny speed takes for ever, and "now" plus that
/// must still be a time.
inline constexpr Duration kForEver = std::chrono::hours(24 * 365 * 200);
/// At most kForEver, at least its opposite; kForEver when `s` is no number.
constexpr Duration from_seconds(double s) {
    if (!(s < seconds(kForEver))) return kForEver;
    if (s <= -seconds(kForEver)) return -kForEver;
    return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(s));
}

}  // namespace pulseline
