#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/fleet/state/new_order.hpp"

/// What makes job orders again and again: templates for people and programs, schedules by time.
namespace pulseline::fleet {

/// An order body with names for what changes. The body is the API's text and opaque here.
struct OrderTemplate {
    std::string name;
    std::string description;
    std::string parameters;  // text of the API: names, types, defaults
    std::string body;        // text of the API: an order with "${name}" in it
    std::string created_by;
    Time created;
    bool deleted = false;  // in records only: the row goes
    bool same_content(const OrderTemplate& other) const {
        return description == other.description && parameters == other.parameters &&
               body == other.body;
    }
};

/// When a schedule makes its orders: every so often from `from` on, or daily at times of day.
struct Recurrence {
    Duration every{0};              // 0: daily
    std::vector<int> daily_at_s;    // seconds after midnight in time_zone, ascending
    std::string time_zone = "UTC";  // name in the tz database
    Duration window{0};             // an order not made this long after its time is left out
    Time from;
    std::optional<Time> until;
    friend bool operator==(const Recurrence&, const Recurrence&) = default;
};

struct NewSchedule {
    std::string name;
    Recurrence recurrence;
    NewOrder order;
    std::string actor;
};

/// Makes one order at each of its times, unless the one before is still open.
struct Schedule {
    ScheduleId id;
    std::string name;
    Recurrence recurrence;
    NewOrder order;
    bool paused = false;
    std::optional<Time> next;  // absent: it is over
    JobOrderId newest_order;   // empty before the first
    std::int64_t made = 0;
    std::int64_t skipped = 0;
    Reason last_skip;  // why the newest skipped one was skipped
    std::string created_by;
    Time created;
    std::int64_t revision = 1;
    bool deleted = false;  // in records only: the row goes
};

/// The fleet's templates and schedules, and which of them this step changed.
struct StandingOrders {
    std::map<std::string, OrderTemplate> templates;
    std::map<ScheduleId, Schedule> schedules;
    std::vector<OrderTemplate> changed_templates;
    std::set<ScheduleId> changed_schedules;
    std::vector<Schedule> deleted_schedules;
    std::map<ScheduleId, std::int64_t> skipped_in_a_row;  // times, for the same reason
};

}  // namespace pulseline::fleet
