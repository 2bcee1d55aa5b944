#include "db/fleet/standing_rows.hpp"

#include "db/fleet/order_json.hpp"
#include "db/json_text.hpp"
#include "db/names.hpp"

namespace pulseline::db {

void ScheduleRow::set(const fleet::Schedule& schedule) {
    const auto& when = schedule.recurrence;
    id = stored_id(schedule.id);
    name = schedule.name;
    every_ns = when.every.count();
    daily_at_s = seconds_to_json(when.daily_at_s);
    time_zone = when.time_zone;
    window_ns = when.window.count();
    from_ns = to_ns(when.from);
    until_ns = when.until ? to_ns(*when.until) : 0;
    body = body_to_json(schedule.order);
    paused = schedule.paused;
    next_ns = schedule.next ? to_ns(*schedule.next) : 0;
    newest_order = stored_id(schedule.newest_order);
    made = schedule.made;
    skipped = schedule.skipped;
    last_skip_code = schedule.last_skip.code;
    last_skip_params = params_to_json(schedule.last_skip.params);
    created_by = schedule.created_by;
    created_ns = to_ns(schedule.created);
    revision = schedule.revision;
}

fleet::Schedule ScheduleRow::get() const {
    fleet::Schedule schedule;
    read_id(id, schedule.id);
    schedule.name = name;
    schedule.recurrence.every = Duration(every_ns);
    schedule.recurrence.daily_at_s = seconds_from_json(daily_at_s);
    schedule.recurrence.time_zone = time_zone;
    schedule.recurrence.window = Duration(window_ns);
    schedule.recurrence.from = time_from_ns(from_ns);
    if (until_ns != 0) schedule.recurrence.until = time_from_ns(until_ns);
    schedule.order = body_from_json(body);
    schedule.paused = paused != 0;
    if (next_ns != 0) schedule.next = time_from_ns(next_ns);
    read_id(newest_order, schedule.newest_order);
    schedule.made = count(made);
    schedule.skipped = count(skipped);
    schedule.last_skip = {last_skip_code, params_from_json(last_skip_params)};
    schedule.created_by = created_by;
    schedule.created = time_from_ns(created_ns);
    schedule.revision = count(revision);
    return schedule;
}

void TemplateRow::set(const fleet::OrderTemplate& one) {
    name = one.name;
    description = one.description;
    parameters = one.parameters;
    body = one.body;
    created_by = one.created_by;
    created_ns = to_ns(one.created);
}

fleet::OrderTemplate TemplateRow::get() const {
    return {name, description, parameters, body, created_by, time_from_ns(created_ns), false};
}

}  // namespace pulseline::db
