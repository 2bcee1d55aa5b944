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

}  // namespace
}  // namespace pulseline::fleet::testing
