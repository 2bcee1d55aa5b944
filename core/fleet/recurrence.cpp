#include <algorithm>

#include "core/fleet/standing_orders.hpp"

namespace pulseline::fleet {
namespace {

constexpr std::int64_t kDay_ns = 86'400LL * 1'000'000'000;

/// Floor division: times before 1970 are nobody's, but must not round up.
std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

Time daily(std::int64_t day, int second) {
    return time_from_ns(day * kDay_ns + std::int64_t{second} * 1'000'000'000);
}

std::optional<Time> next_daily(const Recurrence& r, Time after) {
    const std::int64_t day = floor_div(to_ns(after), kDay_ns);
    for (std::int64_t d = day; d <= day + 1; ++d) {
        for (const int second : r.daily_at_s) {
            if (const Time at = daily(d, second); at > after) return at;
        }
    }
    return std::nullopt;
}

std::optional<Time> last_daily(const Recurrence& r, Time now) {
    const std::int64_t day = floor_div(to_ns(now), kDay_ns);
    for (std::int64_t d = day; d >= day - 1; --d) {
        for (auto it = r.daily_at_s.rbegin(); it != r.daily_at_s.rend(); ++it) {
            if (const Time at = daily(d, *it); at <= now) return at;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<Time> next_time(const Recurrence& r, Time after) {
    std::optional<Time> at;
    if (r.every > Duration::zero()) {
        at = after < r.from ? r.from : r.from + ((after - r.from) / r.every + 1) * r.every;
    } else {
        // One nanosecond before `from`, so that a time equal to it counts.
        at = next_daily(r, std::max(after, r.from - Duration(1)));
    }
    if (at && r.until && *at > *r.until) return std::nullopt;
    return at;
}

std::optional<Time> last_time(const Recurrence& r, Time now) {
    const Time end = r.until ? std::min(now, *r.until) : now;
    if (end < r.from) return std::nullopt;
    std::optional<Time> at;
    if (r.every > Duration::zero()) {
        at = r.from + ((end - r.from) / r.every) * r.every;
    } else {
        at = last_daily(r, end);
    }
    return at && *at >= r.from ? at : std::nullopt;
}

}  // namespace pulseline::fleet
