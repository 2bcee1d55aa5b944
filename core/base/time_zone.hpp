#pragma once

#include <cstdint>
#include <string>

#include "core/base/time.hpp"

/// What clocks on the wall show, by the zones of the machine's tz database (package tzdata).
namespace pulseline {

/// Whether there is a zone of this name: "Europe/Berlin", "UTC".
bool is_time_zone(const std::string& name);

/// The date there at `t`, as days after 1970-01-01. REQUIRES: is_time_zone(zone).
std::int64_t local_day(const std::string& zone, Time t);

/// When clocks there show `second` after midnight of `day`. What the change to summer time leaves
/// out comes at the change; what comes twice in autumn counts the first time.
/// REQUIRES: is_time_zone(zone).
Time local_time(const std::string& zone, std::int64_t day, int second);

}  // namespace pulseline
