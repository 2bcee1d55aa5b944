#include "server/server_clock.hpp"

#include <gtest/gtest.h>

namespace pulseline::server {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

const Time kBoot{hours(5)};  // of the steady clock

/// The machine's two clocks, told by the test.
struct Machine {
    Time utc = ServerClock::built() + hours(24);
    Time steady = kBoot;
    ServerClock start(Time last_stored) {
        return ServerClock(
            last_stored, [this] { return utc; }, [this] { return steady; });
    }
    /// Both go on; follow() is called every second.
    void pass(ServerClock& clock, int seconds_long) {
        for (int i = 0; i < seconds_long; ++i) {
            utc += seconds(1);
            steady += seconds(1);
            clock.follow();
        }
    }
};

TEST(ServerClock, IsUtc) {
    Machine machine;
    auto clock = machine.start(machine.utc - hours(1));

    EXPECT_EQ(clock.now(), machine.utc);
    machine.pass(clock, 100);
    EXPECT_EQ(clock.now(), machine.utc);
}

TEST(ServerClock, DoesNotStartBeforeWhatWasStoredAMomentAgo) {
    Machine machine;
    const auto stored = machine.utc + seconds(30);
    auto clock = machine.start(stored);

    EXPECT_EQ(clock.now(), stored);
    EXPECT_EQ(clock.ahead(), seconds(30));
}

TEST(ServerClock, ReturnsToUtcAtTheNextStartAfterAClockThatWasYearsAhead) {
    Machine machine;
    auto clock = machine.start(machine.utc + hours(24 * 365 * 10));

    EXPECT_EQ(clock.now(), machine.utc);
}

TEST(ServerClock, DoesNotBelieveAClockThatFellBackToItsBeginning) {
    Machine machine;
    const auto stored = machine.utc;
    machine.utc = Time{};  // 1970
    auto clock = machine.start(stored);

    EXPECT_EQ(clock.now(), stored);
}

TEST(ServerClock, CatchesUpWithUtcAfterTheMachineSlept) {
    Machine machine;
    auto clock = machine.start(Time{});
    machine.utc += minutes(5);  // the steady clock stood still
    clock.follow();
    EXPECT_EQ(clock.ahead(), -minutes(5));
    const auto before = clock.now();

    machine.pass(clock, 1);
    EXPECT_EQ(clock.now() - before, milliseconds(1100))
        << "and not at once: silence is counted in it";
    machine.pass(clock, 60 * 55);

    EXPECT_LT(std::chrono::abs(clock.ahead()), milliseconds(200));
}

TEST(ServerClock, NeverGoesBackWhenUtcDoes) {
    Machine machine;
    auto clock = machine.start(Time{});
    machine.utc -= hours(1);
    auto last = clock.now();
    for (int i = 0; i < 100; ++i) {
        machine.pass(clock, 1);
        EXPECT_GT(clock.now(), last);
        last = clock.now();
    }
    EXPECT_LT(clock.ahead(), hours(1)) << "it waits for UTC, slowly";
}

}  // namespace
}  // namespace pulseline::server
