#include <gtest/gtest.h>

#include <algorithm>

#include "core/fleet/orders/recurrence.hpp"
#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

const plant::VehicleId kV1("V1");
constexpr std::int64_t kDay_s = 86'400;

Time at(std::int64_t day, int second) {
    return time_from_ns((day * kDay_s + second) * 1'000'000'000);
}

// --- times ---

TEST(Recurrence, EveryCountsFromItsFirstTime) {
    Recurrence r;
    r.every = std::chrono::seconds(100);
    r.from = at(10, 50);
    EXPECT_EQ(next_time(r, at(9, 0)), r.from);
    EXPECT_EQ(next_time(r, at(10, 50)), at(10, 150));
    EXPECT_EQ(next_time(r, at(10, 149)), at(10, 150));
    EXPECT_EQ(last_time(r, at(10, 49)), std::nullopt);
    EXPECT_EQ(last_time(r, at(10, 349)), at(10, 250));
}

TEST(Recurrence, DailyTimesGoOnTheNextDay) {
    Recurrence r;
    r.daily_at_s = {6 * 3600, 14 * 3600};
    EXPECT_EQ(next_time(r, at(10, 6 * 3600 - 1)), at(10, 6 * 3600));
    EXPECT_EQ(next_time(r, at(10, 6 * 3600)), at(10, 14 * 3600));
    EXPECT_EQ(next_time(r, at(10, 20 * 3600)), at(11, 6 * 3600));
    EXPECT_EQ(last_time(r, at(10, 3600)), at(9, 14 * 3600));
}

TEST(Recurrence, DailyTimesFollowTheClockOfTheirZone) {
    Recurrence r;
    r.daily_at_s = {6 * 3600};
    r.time_zone = "Europe/Berlin";
    const std::int64_t change = 20'541;  // 2026-03-29
    EXPECT_EQ(next_time(r, at(change - 1, 0)), at(change - 1, 5 * 3600));
    EXPECT_EQ(next_time(r, at(change - 1, 5 * 3600)), at(change, 4 * 3600)) << "23 hours later";
    EXPECT_EQ(last_time(r, at(change, 4 * 3600)), at(change, 4 * 3600));
    EXPECT_EQ(last_time(r, at(change, 4 * 3600 - 1)), at(change - 1, 5 * 3600));
}

TEST(Recurrence, WhatTheChangeOfTheClockLeavesOutComesAtTheChangeAndOnce) {
    Recurrence r;
    r.daily_at_s = {2 * 3600, 2 * 3600 + 1800, 3 * 3600 + 600};
    r.time_zone = "Europe/Berlin";
    const std::int64_t change = 20'541;
    EXPECT_EQ(next_time(r, at(change, 0)), at(change, 3600)) << "02:00 and 02:30 are 03:00 there";
    EXPECT_EQ(next_time(r, at(change, 3600)), at(change, 3600 + 600));
    EXPECT_EQ(next_time(r, at(change, 3600 + 600)), at(change + 1, 0));
}

TEST(Recurrence, AZoneThatIsNoMoreMakesNothing) {
    Recurrence r;
    r.daily_at_s = {3600};
    r.time_zone = "Europe/Atlantis";
    EXPECT_EQ(next_time(r, at(10, 0)), std::nullopt);
    EXPECT_EQ(last_time(r, at(10, 0)), std::nullopt);
}

TEST(Recurrence, EndsAfterUntil) {
    Recurrence r;
    r.daily_at_s = {3600};
    r.from = at(10, 3600);
    r.until = at(11, 3600);
    EXPECT_EQ(next_time(r, at(10, 0)), at(10, 3600)) << "from itself counts";
    EXPECT_EQ(next_time(r, at(10, 3600)), at(11, 3600)) << "until itself counts";
    EXPECT_EQ(next_time(r, at(11, 3600)), std::nullopt);
}

// --- over the fleet ---

struct Schedules : ::testing::Test {
    Schedules() { world.connect_all(); }
    NewSchedule every(double seconds) {
        NewSchedule wanted;
        wanted.name = "round";
        wanted.recurrence.every = from_seconds(seconds);
        wanted.recurrence.window = from_seconds(seconds);
        wanted.order.vehicle = kV1;
        wanted.order.steps = {{2}, {1}};
        wanted.actor = "mes";
        return wanted;
    }
    Schedule make(const NewSchedule& wanted) {
        const auto made = world.fleet->create_schedule(wanted, world.now);
        EXPECT_TRUE(made) << made.error().what;
        world.settle();
        return *made;
    }
    Schedule now(ScheduleId id) { return world.store.schedules.at(id); }
    World world;
};

TEST_F(Schedules, MakeOneOrderAtEachTime) {
    const Time start = world.now;
    const auto id = make(every(100)).id;
    world.run(250);

    ASSERT_EQ(world.store.orders.size(), 3u);
    int i = 0;
    for (const auto& [order_id, order] : world.store.orders) {
        EXPECT_EQ(order.state, JobState::kEnded);
        EXPECT_EQ(order.from_schedule, id);
        EXPECT_EQ(order.created_by, "schedule:round");
        EXPECT_NEAR(seconds(order.created - start), 100.0 * i, 0.2);
        EXPECT_NEAR(seconds(*order.due - start), 100.0 * (i + 1), 1e-6) << "the window's end";
        ++i;
    }
    EXPECT_EQ(now(id).made, 3);
    EXPECT_EQ(now(id).skipped, 0);
}

TEST_F(Schedules, LeaveATimeOutWhileTheOrderBeforeIsOpen) {
    const auto id = make(every(100)).id;
    world.run(1);
    world.vehicles_move = false;
    world.run(250);

    EXPECT_EQ(world.store.orders.size(), 1u);
    EXPECT_EQ(now(id).skipped, 2);
    EXPECT_EQ(now(id).last_skip.code, "previous_order_open");
    EXPECT_EQ(world.count_events("job_order_schedule.skipped"), 1) << "and no more for this reason";

    world.vehicles_move = true;
    world.run(150);
    const Param left_out{"skipped_before", std::int64_t{2}};
    const auto told = std::ranges::count_if(world.store.events, [&](const Event& event) {
        return event.type == "job_order_schedule.made" &&
               std::ranges::count(event.params, left_out) == 1;
    });
    EXPECT_EQ(told, 1) << "by the first that is made again";
}

TEST_F(Schedules, OfTheSameTimeAreMadeSomeAtATick) {
    NewSchedule wanted = every(3600);
    wanted.recurrence.from = world.now + std::chrono::seconds(10);
    for (int i = 0; i < 20; ++i) {
        wanted.name = "round " + std::to_string(i);
        make(wanted);
    }
    std::size_t before = 0;
    std::size_t most = 0;
    world.now += std::chrono::seconds(10);
    for (int i = 0; i < 10; ++i) {
        world.now += std::chrono::milliseconds(50);
        world.fleet->tick(world.now);
        world.settle();
        most = std::max(most, world.store.orders.size() - before);
        before = world.store.orders.size();
    }

    EXPECT_EQ(before, 20U);
    EXPECT_LE(most, 4U) << "each is planned: nobody else may wait for all";
    for (const auto& [id, schedule] : world.store.schedules) EXPECT_EQ(schedule.skipped, 0);
}

TEST_F(Schedules, WaitForAPersonAfterARestartAndMakeNoBurst) {
    const auto id = make(every(100)).id;
    world.run(60);
    ASSERT_EQ(world.only_order().state, JobState::kEnded);
    const int driven = world.vehicle("V1").node_steps;

    world.now += std::chrono::hours(10);
    world.crash_server();
    world.run(150);

    EXPECT_EQ(now(id).made, 2) << "the newest time only, then the one before is open";
    EXPECT_GE(now(id).skipped, 1);
    EXPECT_EQ(world.vehicle("V1").node_steps, driven) << "nothing moves by itself after a restart";
    EXPECT_EQ(world.store.vehicles.at(kV1).needs_resume_reason.code, "server_restarted");
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.store.orders.rbegin()->second.state, JobState::kEnded);
}

TEST_F(Schedules, ATimeOutsideItsWindowIsLeftOut) {
    NewSchedule daily = every(0);
    daily.recurrence.every = Duration{0};
    daily.recurrence.window = std::chrono::minutes(10);
    const std::int64_t second = to_ns(world.now) / 1'000'000'000 % kDay_s;
    daily.recurrence.daily_at_s = {static_cast<int>((second + 60) % kDay_s)};
    const auto id = make(daily).id;

    world.now += std::chrono::minutes(30);  // the server was down
    world.run(1);

    EXPECT_TRUE(world.store.orders.empty());
    EXPECT_EQ(now(id).last_skip.code, "time_missed");
    EXPECT_GT(*now(id).next, world.now) << "tomorrow again";
}

TEST_F(Schedules, PausedOnesMakeNothingAndGoOnWithoutCatchingUp) {
    const auto id = make(every(100)).id;
    world.run(60);
    ASSERT_TRUE(world.fleet->pause_schedule(id, true, std::nullopt, "op", world.now));
    world.run(500);
    EXPECT_EQ(now(id).made, 1);

    ASSERT_TRUE(world.fleet->pause_schedule(id, false, std::nullopt, "op", world.now));
    world.run(100);
    EXPECT_EQ(now(id).made, 2);
}

TEST_F(Schedules, DeletedOnesAreGoneAndTheirOrdersStay) {
    const auto id = make(every(100)).id;
    world.run(10);
    ASSERT_TRUE(world.fleet->delete_schedule(id, std::nullopt, "op", world.now));
    world.run(300);

    EXPECT_TRUE(world.store.schedules.empty());
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
    EXPECT_EQ(world.fleet->delete_schedule(id, std::nullopt, "op", world.now).error().reason.code,
              "unknown_schedule");
    EXPECT_NE(make(every(100)).id, id) << "its name is free";
}

TEST_F(Schedules, TheSameTwiceIsOneAnotherOfItsNameAConflict) {
    const auto first = make(every(100));
    EXPECT_EQ(make(every(100)).id, first.id);
    const auto other = world.fleet->create_schedule(every(50), world.now);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().reason.code, "duplicate_schedule");
    EXPECT_EQ(world.store.schedules.size(), 1u);
}

TEST_F(Schedules, AnImpossibleOrderIsRefusedWithItsField) {
    NewSchedule wanted = every(100);
    wanted.order.steps.at(1).station_number = 99;
    const auto refused = world.fleet->create_schedule(wanted, world.now);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "/order/steps/1/station");

    wanted = every(100);
    wanted.recurrence.from = world.now;
    wanted.recurrence.until = world.now - from_seconds(1);
    EXPECT_EQ(world.fleet->create_schedule(wanted, world.now).error().field, "/until");
}

TEST_F(Schedules, AreTheSameAfterARestart) {
    const auto id = make(every(100)).id;
    world.run(10);
    const Schedule before = *world.fleet->schedule(id);
    world.crash_server();
    const Schedule after = *world.fleet->schedule(id);
    EXPECT_EQ(after.next, before.next);
    EXPECT_EQ(after.made, 1);
    EXPECT_EQ(after.recurrence, before.recurrence);
    EXPECT_EQ(after.order, before.order);
}

TEST_F(Schedules, MakeTheSameOrdersAtTheSameTimesInEveryRun) {
    const auto events = [] {
        World own;
        own.connect_all();
        NewSchedule wanted;
        wanted.name = "round";
        wanted.recurrence.every = std::chrono::seconds(70);
        wanted.recurrence.window = std::chrono::seconds(70);
        wanted.order.steps = {{2}, {3}};
        EXPECT_TRUE(own.fleet->create_schedule(wanted, own.now));
        own.run(400);
        std::vector<std::string> seen;
        for (const auto& event : own.store.events) {
            seen.push_back(std::to_string(to_ns(event.at)) + event.type + event.order.str());
        }
        return seen;
    };
    EXPECT_EQ(events(), events());
}

}  // namespace
}  // namespace pulseline::fleet::testing
