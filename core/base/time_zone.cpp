#include "core/base/time_zone.hpp"

#include <absl/time/civil_time.h>
#include <absl/time/time.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace pulseline {
namespace {

constexpr const char* kDatabase = "/usr/share/zoneinfo/";

absl::TimeZone load(const std::string& zone) {
    absl::TimeZone loaded;
    absl::LoadTimeZone(zone, &loaded);
    return loaded;
}

}  // namespace

bool is_time_zone(const std::string& name) {
    if (name == "UTC") return true;
    // Abseil would open any path it is given, and keeps each name that it was ever asked for.
    const bool is_name = !name.empty() && name.front() != '/' && name.size() <= 64 &&
                         std::ranges::all_of(name, [](unsigned char c) {
                             return std::isalnum(c) || c == '/' || c == '_' || c == '+' || c == '-';
                         });
    std::error_code unreadable;
    if (!is_name || !std::filesystem::is_regular_file(kDatabase + name, unreadable)) return false;
    absl::TimeZone loaded;
    return absl::LoadTimeZone(name, &loaded);
}

std::int64_t local_day(const std::string& zone, Time t) {
    const absl::CivilDay day =
        absl::ToCivilDay(absl::UnixEpoch() + absl::Nanoseconds(to_ns(t)), load(zone));
    return day - absl::CivilDay(1970, 1, 1);
}

Time local_time(const std::string& zone, std::int64_t day, int second) {
    const absl::CivilSecond shown = absl::CivilSecond(absl::CivilDay(1970, 1, 1) + day) + second;
    return time_from_ns(absl::ToUnixNanos(absl::FromCivil(shown, load(zone))));
}

}  // namespace pulseline
