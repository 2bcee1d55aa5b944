#include "core/base/time_zone.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pulseline {
namespace {

constexpr std::int64_t kHour_s = 3600;
constexpr int kSix = 6 * 3600;

/// Seconds after midnight UTC of `day`.
std::int64_t utc_s(const std::string& zone, std::int64_t day, int second) {
    return to_ns(local_time(zone, day, second)) / 1'000'000'000 - day * 24 * kHour_s;
}

// Days after 1970-01-01.
constexpr std::int64_t kWinter = 20'468;      // 2026-01-15
constexpr std::int64_t kSummer = 20'649;      // 2026-07-15
constexpr std::int64_t kToSummer = 20'541;    // 2026-03-29, at 01:00 UTC in Europe
constexpr std::int64_t kFromSummer = 20'751;  // 2026-10-25, at 01:00 UTC

TEST(TimeZone, KnowsTheNamesOfTheDatabaseAndNoPath) {
    for (const char* name :
         {"UTC", "Europe/Berlin", "Asia/Shanghai", "America/Argentina/Ushuaia", "Etc/GMT+5"}) {
        EXPECT_TRUE(is_time_zone(name)) << name;
    }
    for (const char* name :
         {"", "Berlin", "Europe", "Europe/berlin ", "../../etc/passwd", "/usr/share/zoneinfo/UTC",
          "file:/etc/passwd", "tzdata.zi", "+08:00", "Europe/Berlin\n"}) {
        EXPECT_FALSE(is_time_zone(name)) << name;
    }
    EXPECT_FALSE(is_time_zone(std::string("UTC\0x", 5)));
    EXPECT_FALSE(is_time_zone(std::string(65, 'A')));
}

TEST(TimeZone, SixIsSixSummerAndWinter) {
    EXPECT_EQ(utc_s("UTC", kSummer, kSix), 6 * kHour_s);
    EXPECT_EQ(utc_s("Europe/Berlin", kWinter, kSix), 5 * kHour_s);
    EXPECT_EQ(utc_s("Europe/Berlin", kSummer, kSix), 4 * kHour_s);
    EXPECT_EQ(utc_s("Asia/Shanghai", kSummer, kSix), -2 * kHour_s);
}

TEST(TimeZone, TheHourThatIsLeftOutComesAtTheChangeAndTheOneThatComesTwiceAtItsFirst) {
    const int half_past_two = 2 * 3600 + 1800;
    EXPECT_EQ(utc_s("Europe/Berlin", kToSummer, half_past_two), kHour_s) << "03:00 there";
    EXPECT_EQ(utc_s("Europe/Berlin", kFromSummer, half_past_two), 1800) << "still summer time";
}

TEST(TimeZone, TheDateIsTheOneThere) {
    const Time late = local_time("UTC", kSummer, 23 * 3600);
    EXPECT_EQ(local_day("UTC", late), kSummer);
    EXPECT_EQ(local_day("Europe/Berlin", late), kSummer + 1);
    EXPECT_EQ(local_day("America/New_York", late), kSummer);
    EXPECT_EQ(local_day("UTC", time_from_ns(-1)), -1);
}

}  // namespace
}  // namespace pulseline
