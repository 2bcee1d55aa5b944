#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// The server ran for a while with a clock that was ten years ahead, and starts again with a right
// one.
namespace pulseline::fleet::testing {
namespace {

class ClockAhead : public ::testing::Test {
protected:
    ClockAhead() {
        world.run(1);
        NewSchedule wanted;
        wanted.name = "round";
        wanted.recurrence.every = std::chrono::seconds(100);
        wanted.recurrence.window = std::chrono::seconds(100);
        wanted.order.vehicle = plant::VehicleId("V1");
        wanted.order.steps = {{2, plant::MotionMode::kAuto}};
        EXPECT_TRUE(world.fleet->create_schedule(wanted, world.now));
        world.settle();
        world.run(30);
        ahead = world.store.load().last_time;
        right = ahead - std::chrono::hours(24 * 365 * 10);
        world.now = right;
        world.crash_server();
    }
    World world;
    Time ahead;
    Time right;
};

TEST_F(ClockAhead, IsToldAndLeavesNoTimeInTheFuture) {
    EXPECT_EQ(world.count_events("clock.was_ahead"), 1);
    EXPECT_EQ(world.store.events.back().seq, static_cast<std::int64_t>(world.store.events.size()));
    EXPECT_LE(world.store.events.back().at, world.now);
    for (const auto& order : world.fleet->orders()) EXPECT_LE(order.created, world.now);
}

TEST_F(ClockAhead, SchedulesGoOnByTheRightTime) {
    const auto& schedule = world.store.schedules.begin()->second;
    ASSERT_TRUE(schedule.next);
    EXPECT_LE(*schedule.next - world.now, std::chrono::seconds(100));
}

TEST_F(ClockAhead, NewOrdersStillSortBehindOldOnes) {
    const auto old = world.store.orders.rbegin()->first;
    const auto made = world.order("V2", {3});

    ASSERT_TRUE(made) << made.error().what;
    EXPECT_GT(made->order.id, old);
}

// A schedule of one time a day, made while the clock was right; then the clock is set on by
// `ahead`, the time comes by it, and the server starts again by a right one.
class EarlyDay : public ::testing::Test {
protected:
    std::optional<Time> next_after(Duration ahead) {
        using std::chrono::hours;
        const Time midnight = world.now - world.now.time_since_epoch() % hours(24) + hours(48);
        six = midnight + hours(6);
        NewSchedule wanted;
        wanted.name = "morning";
        wanted.recurrence.daily_at_s = {6 * 3600};
        wanted.recurrence.window = std::chrono::minutes(30);
        wanted.order.vehicle = plant::VehicleId("V1");
        wanted.order.steps = {{2, plant::MotionMode::kAuto}};
        EXPECT_TRUE(world.fleet->create_schedule(wanted, world.now));
        world.settle();
        world.now = six - ahead + std::chrono::minutes(5);  // the truth
        const Time right = world.now;
        world.now += ahead;
        world.crash_server();  // started again by the wrong clock
        world.run(1);
        EXPECT_EQ(world.store.schedules.begin()->second.made, 1);
        world.now = right + std::chrono::minutes(1);
        world.crash_server();
        return world.store.schedules.begin()->second.next;
    }
    World world;
    Time six;
};

TEST_F(EarlyDay, ATimeThatWasKeptAnHourTooEarlyIsNotKeptTwice) {
    const auto next = next_after(std::chrono::hours(1));
    EXPECT_EQ(next, six + std::chrono::hours(24));
}

TEST_F(EarlyDay, ATimeThatWasKeptADayTooEarlyIsKeptOnItsDay) {
    const auto next = next_after(std::chrono::hours(24));
    EXPECT_EQ(next, six);
}

TEST(ClockDiffers, IsToldAndShownUntilItAgrees) {
    World world;
    world.fleet->clock_differs(std::chrono::hours(-1), world.now);
    world.settle();
    ASSERT_TRUE(world.fleet->view(world.now).clock_difference);
    const Time since = world.fleet->view(world.now).clock_difference->since;

    world.run(2);
    world.fleet->clock_differs(std::chrono::hours(1), world.now);
    world.settle();
    EXPECT_EQ(world.fleet->view(world.now).clock_difference->ahead, std::chrono::hours(1));
    EXPECT_EQ(world.fleet->view(world.now).clock_difference->since, since);

    world.fleet->clock_agrees(world.now);
    world.fleet->clock_agrees(world.now);
    world.settle();
    EXPECT_FALSE(world.fleet->view(world.now).clock_difference);
    EXPECT_EQ(world.count_events("clock.differs"), 2);
    EXPECT_EQ(world.count_events("clock.agrees"), 1);
}

}  // namespace
}  // namespace pulseline::fleet::testing
