#include "core/base/time.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pulseline {
namespace {

TEST(FromSeconds, OfAnyNumberCanBeAddedToATime) {
    constexpr double kLarge = std::numeric_limits<double>::max();
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    constexpr Time kNow = time_from_ns(1'800'000'000'000'000'000);
    for (const double s : {1e10, 1e300, kLarge, kInfinite}) {
        EXPECT_EQ(from_seconds(s), kForEver) << s;
        EXPECT_EQ(from_seconds(-s), -kForEver) << s;
        EXPECT_GT(kNow + from_seconds(s), kNow);
        EXPECT_LT(kNow + from_seconds(-s), kNow);
    }
    EXPECT_EQ(from_seconds(std::numeric_limits<double>::quiet_NaN()), kForEver);
    EXPECT_EQ(from_seconds(5e-324), Duration{0});
    EXPECT_EQ(from_seconds(1.5), std::chrono::milliseconds(1500));
    EXPECT_EQ(from_seconds(-0.25), std::chrono::milliseconds(-250));
}

}  // namespace
}  // namespace pulseline
