#include "server/base/server_clock.hpp"

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

TEST(ServerClock, KeepsItsPaceWhileUtcIsOneThatCannotBeTrue) {
    Machine machine;
    auto clock = machine.start(Time{});
    const Time right = machine.utc;
    machine.utc = Time{};  // 1970
    clock.follow();
    EXPECT_EQ(clock.ahead(), right - Time{}) << "people are told";

    machine.pass(clock, 3600);
    EXPECT_EQ(clock.now(), right + hours(1)) << "an hour's schedule is kept in an hour";

    machine.utc = right + hours(1);
    clock.follow();
    EXPECT_EQ(clock.ahead(), Duration::zero()) << "and nothing has to be made up for";
}

TEST(ServerClock, KeepsItsPaceWhenItWasStartedIn1970) {
    Machine machine;
    const Time stored = machine.utc;
    machine.utc = Time{};
    auto clock = machine.start(stored);

    machine.pass(clock, 3600);

    EXPECT_EQ(clock.now(), stored + hours(1));
}

using News = ClockWatch::News;

TEST(ClockWatch, TellsOnceThatTheClocksDifferAndOnceThatTheyAgree) {
    ClockWatch watch;
    EXPECT_EQ(watch.look(seconds(9)), News::kNone);
    EXPECT_EQ(watch.look(-seconds(3600)), News::kDiffers);
    EXPECT_EQ(watch.look(-seconds(3599)), News::kNone);
    EXPECT_EQ(watch.look(seconds(1)), News::kAgrees);
    EXPECT_EQ(watch.look(seconds(1)), News::kNone);
}

TEST(ClockWatch, TellsOfTheNextJumpToo) {
    ClockWatch watch;
    EXPECT_EQ(watch.look(-hours(1)), News::kDiffers);
    EXPECT_EQ(watch.look(hours(1)), News::kDiffers);
    EXPECT_EQ(watch.look(hours(24)), News::kDiffers);
}

TEST(ClockWatch, TellsOfAClockThatStandsStillAFewTimesOnly) {
    ClockWatch watch;
    int told = 0;
    for (int s = 0; s < 3600; ++s) told += watch.look(seconds(s)) == News::kDiffers ? 1 : 0;
    EXPECT_GT(told, 5);
    EXPECT_LT(told, 20);
}

TEST(ClockWatch, TellsAgainWhatDidNotArrive) {
    ClockWatch watch;
    EXPECT_EQ(watch.look(hours(1)), News::kDiffers);
    watch.not_told();
    EXPECT_EQ(watch.look(hours(1)), News::kDiffers);
    watch.not_told();
    EXPECT_EQ(watch.look(seconds(0)), News::kAgrees);
}

}  // namespace
}  // namespace pulseline::server
