#include "core/base/id.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pulseline {
namespace {

TEST(IdSource, MakesVersion7IdsThatSortAsMade) {
    IdSource ids(7);
    Uuid last = ids.next(time_from_ns(1'800'000'000'000'000'000));
    for (int i = 0; i < 10'000; ++i) {
        const Uuid id = ids.next(time_from_ns(1'800'000'000'000'000'000 + i * 1000));
        EXPECT_LT(last, id);
        EXPECT_EQ(id.bytes[6] >> 4, 7);
        EXPECT_EQ(id.bytes[8] >> 6, 2);
        last = id;
    }
}

TEST(IdSource, SameSeedAndTimesGiveTheSameIds) {
    IdSource a(42);
    IdSource b(42);
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(a.next(time_from_ns(i * 1'000'000)), b.next(time_from_ns(i * 1'000'000)));
    }
}

TEST(Uuid, TextRoundTrips) {
    IdSource ids(1);
    for (int i = 0; i < 100; ++i) {
        const Uuid id = ids.next(time_from_ns(i));
        EXPECT_EQ(parse_uuid(to_string(id)), id);
    }
}

TEST(Uuid, RefusesWhatIsNone) {
    for (const char* text :
         {"", "x", "0190a0b0-0000-7000-8000-00000000000", "0190a0b0-0000-7000-8000-0000000000000",
          "0190a0b00000-7000-8000-0000-000000000", "0190a0b0-0000-7000-8000-00000000000g"}) {
        EXPECT_FALSE(parse_uuid(text)) << text;
    }
}

}  // namespace
}  // namespace pulseline
