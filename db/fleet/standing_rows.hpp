#pragma once

#include <cstdint>
#include <string>
#include <tuple>

#include "core/fleet/state/standing_orders.hpp"

/// Rows of templates and schedules, as fleet_rows.hpp.
namespace pulseline::db {

struct ScheduleRow {
    static constexpr const char* kColumns =
        "id, name, every_ns, daily_at_s, time_zone, window_ns, from_ns, until_ns, body, paused, "
        "next_ns, "
        "newest_order, made, skipped, last_skip_code, last_skip_params, created_by, created_ns, "
        "revision";
    std::string id, name, daily_at_s, time_zone, body, newest_order, last_skip_code,
        last_skip_params, created_by;
    std::int64_t every_ns = 0, window_ns = 0, from_ns = 0, until_ns = 0, next_ns = 0, made = 0,
                 skipped = 0, created_ns = 0, revision = 0;
    int paused = 0;

    auto fields() {
        return std::tie(id, name, every_ns, daily_at_s, time_zone, window_ns, from_ns, until_ns,
                        body, paused, next_ns, newest_order, made, skipped, last_skip_code,
                        last_skip_params, created_by, created_ns, revision);
    }
    void set(const fleet::Schedule& schedule);
    fleet::Schedule get() const;
};

struct TemplateRow {
    static constexpr const char* kColumns =
        "name, description, parameters, body, created_by, created_ns";
    std::string name, description, parameters, body, created_by;
    std::int64_t created_ns = 0;

    auto fields() { return std::tie(name, description, parameters, body, created_by, created_ns); }
    void set(const fleet::OrderTemplate& one);
    fleet::OrderTemplate get() const;
};

}  // namespace pulseline::db
