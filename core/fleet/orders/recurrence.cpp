#include "core/fleet/orders/recurrence.hpp"

#include <algorithm>

#include "core/base/time_zone.hpp"
#include "core/fleet/state/standing_orders.hpp"

namespace pulseline::fleet {
namespace {

/// Its times on the days `first` to `last` days after that of `t`, as clocks there show them. Two
/// of them can be one moment, and their order is not that of the clock, where summer time begins.
std::vector<Time> daily(const Recurrence& r, Time t, int first, int last) {
    std::vector<Time> times;
    if (!is_time_zone(r.time_zone)) return times;  // gone from the database since: nothing is made
    const std::int64_t today = local_day(r.time_zone, t);
    for (std::int64_t day = today + first; day <= today + last; ++day) {
        for (const int second : r.daily_at_s) {
            times.push_back(local_time(r.time_zone, day, second));
        }
    }
    std::ranges::sort(times);
    return times;
}

std::optional<Time> next_daily(const Recurrence& r, Time after) {
    const std::vector<Time> times = daily(r, after, 0, 2);
    const auto it = std::ranges::upper_bound(times, after);
    return it == times.end() ? std::nullopt : std::optional(*it);
}

std::optional<Time> last_daily(const Recurrence& r, Time now) {
    const std::vector<Time> times = daily(r, now, -2, 0);
    const auto it = std::ranges::upper_bound(times, now);
    return it == times.begin() ? std::nullopt : std::optional(*std::prev(it));
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
