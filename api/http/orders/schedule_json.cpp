#include "api/http/orders/schedule_json.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "api/http/orders/order_body.hpp"
#include "api/http/wire/body.hpp"
#include "core/base/time_zone.hpp"

namespace pulseline::api {
namespace {

using json::FieldErrors;
using json::ObjectReader;

// A drive takes longer; what is wanted more often is one order with many steps.
constexpr std::int64_t kLeastEvery_s = 60;
constexpr std::int64_t kYear_s = 366LL * 86'400;
constexpr std::int64_t kDay_s = 86'400;
constexpr std::int64_t kDailyWindow_s = 3'600;
constexpr std::size_t kMaxTimesOfDay = 96;

/// Seconds after midnight of "06:30" or "06:30:15"; -1: it is none.
int second_of_day(const std::string& text) {
    const auto part = [&](std::size_t at, int limit) {
        if (at + 2 > text.size() || text[at] < '0' || text[at] > '9' || text[at + 1] < '0' ||
            text[at + 1] > '9') {
            return -1;
        }
        const int value = 10 * (text[at] - '0') + (text[at + 1] - '0');
        return value < limit ? value : -1;
    };
    const bool with_seconds = text.size() == 8 && text[5] == ':';
    if ((text.size() != 5 && !with_seconds) || text[2] != ':') return -1;
    const int hour = part(0, 24);
    const int minute = part(3, 60);
    const int second = with_seconds ? part(6, 60) : 0;
    return hour < 0 || minute < 0 || second < 0 ? -1 : 3600 * hour + 60 * minute + second;
}

fleet::Recurrence read_recurrence(ObjectReader& in) {
    fleet::Recurrence when;
    const bool every = in.has("every_s");
    const bool daily = in.has("daily_at");
    if (every == daily) {
        in.errors().add("/every_s", {"every_or_daily", {}},
                        "Give either every_s or daily_at, not both.");
    }
    if (every) when.every = std::chrono::seconds(in.integer("every_s", {kLeastEvery_s, kYear_s}));
    in.items_if_any(
        "daily_at", {1, kMaxTimesOfDay}, [&](const Json& item, const std::string& pointer) {
            const std::string text = json::read_text(item, pointer, in.errors(), {1, 8});
            const int second = second_of_day(text);
            if (second < 0) {
                in.errors().add(pointer, {"bad_time_of_day", {}},
                                "Write the time of day as 06:30 or 06:30:00.");
            }
            when.daily_at_s.push_back(second);
        });
    std::sort(when.daily_at_s.begin(), when.daily_at_s.end());
    const auto same = std::unique(when.daily_at_s.begin(), when.daily_at_s.end());
    when.daily_at_s.erase(same, when.daily_at_s.end());
    when.time_zone = in.text_or("time_zone", when.time_zone, {1, 64});
    if (in.has("time_zone") && !daily) {
        in.errors().add("/time_zone", {"time_zone_without_daily", {}},
                        "A time zone goes with daily_at; leave it out here.");
    } else if (!is_time_zone(when.time_zone)) {
        in.errors().add(
            "/time_zone", {"unknown_time_zone", {{"time_zone", when.time_zone}}},
            "Name a zone of the tz database, as Europe/Berlin, or leave it out for UTC.");
    }
    const std::int64_t usual_s =
        every ? std::max<std::int64_t>(1, when.every / std::chrono::seconds(1)) : kDailyWindow_s;
    when.window =
        std::chrono::seconds(in.integer_or("window_s", std::min(usual_s, kDay_s), {1, kDay_s}));
    when.from = in.time_if_any("from").value_or(Time{});
    when.until = in.time_if_any("until");
    return when;
}

}  // namespace

Result<fleet::NewSchedule> read_new_schedule(const Request& request) {
    const auto body = read_body(request);
    if (!body) return fail(body.error());
    FieldErrors errors;
    ObjectReader in(*body, "", errors);
    fleet::NewSchedule wanted;
    wanted.name = in.text("name", {1, 64});
    wanted.recurrence = read_recurrence(in);
    ObjectReader order = in.object("order");
    if (in.has("order")) wanted.order = read_order_body(order, OrderUse::kSchedule);
    in.refuse_unknown();
    if (const Status ok = errors.status(); !ok) return fail(ok.error());
    wanted.actor = request.identity.name;
    return wanted;
}

Json schedule_json(const fleet::Schedule& schedule) {
    const auto& when = schedule.recurrence;
    const auto seconds_of = [](Duration duration) {
        return duration / std::chrono::nanoseconds(std::chrono::seconds(1));
    };
    Json json = {{"id", schedule.id.str()},
                 {"name", schedule.name},
                 {"window_s", seconds_of(when.window)},
                 {"from", rfc3339(when.from)},
                 {"order", order_body_json(schedule.order)},
                 {"paused", schedule.paused},
                 {"made", schedule.made},
                 {"skipped", schedule.skipped},
                 {"created_by", schedule.created_by},
                 {"created_at", rfc3339(schedule.created)},
                 {"revision", schedule.revision}};
    if (when.every > Duration::zero()) {
        json["every_s"] = seconds_of(when.every);
    } else {
        json["daily_at"] = list_json(when.daily_at_s, [](int s) {
            return fmt::format("{:02}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
        });
        json["time_zone"] = when.time_zone;
    }
    if (when.until) json["until"] = rfc3339(*when.until);
    if (schedule.next && !schedule.paused) json["next_at"] = rfc3339(*schedule.next);
    if (!schedule.newest_order.empty()) json["newest_order"] = schedule.newest_order.str();
    if (!schedule.last_skip.code.empty()) json["last_skip"] = reason_json(schedule.last_skip);
    return json;
}

}  // namespace pulseline::api
