#include <gtest/gtest.h>

#include "server/base/server_clock.hpp"
#include "tests/core/fleet/fleet_world.hpp"

// The fleet by the server's clock while the machine's is set: half an hour round six o'clock, with
// vehicles that drive. tests/faults/clock.test.mjs does the same to the real server, for seconds.
namespace pulseline::fleet::testing {
namespace {

using server::ServerClock;
using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::minutes;

struct Step {
    const char* name;
    Duration set;  // what the machine's clock is set by
    bool stands_still = false;
};

class ClockSteps : public ::testing::TestWithParam<Step> {
protected:
    ClockSteps() {
        utc = ServerClock::built() + hours(72);
        utc += hours(24) - utc.time_since_epoch() % hours(24) + hours(6) - minutes(10);
        clock = std::make_unique<ServerClock>(
            Time{}, [this] { return utc + set; }, [this] { return steady; });
        world.now = clock->now();
        world.crash_server();  // begins the world at this time
        world.connect_all();
        until(minutes(1));
    }
    /// Until so long after the beginning, by a watch on somebody's wrist.
    void until(Duration end) {
        while (passed < end) {
            passed += milliseconds(100);
            steady += milliseconds(100);
            if (!stands_still) utc += milliseconds(100);
            if (passed % std::chrono::seconds(1) == Duration::zero()) clock->follow();
            world.now = clock->now() - milliseconds(100);
            world.run(0.1);
        }
    }
    ScheduleId schedule(const char* name, Recurrence when, const char* vehicle, int station) {
        NewSchedule wanted;
        wanted.name = name;
        wanted.recurrence = std::move(when);
        wanted.recurrence.window = minutes(5);
        wanted.order.vehicle = plant::VehicleId(vehicle);
        wanted.order.steps = {{station, plant::MotionMode::kAuto}};
        const auto made = world.fleet->create_schedule(wanted, world.now);
        EXPECT_TRUE(made);
        world.settle();
        return made ? made->id : ScheduleId{};
    }

    World world;
    Time utc;  // of a machine whose clock nobody has set
    Time steady{hours(5)};
    Duration set{};
    bool stands_still = false;
    Duration passed{};
    std::unique_ptr<ServerClock> clock;
};

TEST_P(ClockSteps, NobodyIsSilentOrdersGoOnAndSixOClockComesOnce) {
    Recurrence daily;
    daily.daily_at_s = {6 * 3600};
    Recurrence often;
    often.every = minutes(4);
    const auto six = schedule("six", daily, "V1", 2);
    const auto round = schedule("round", often, "V2", 3);

    until(minutes(2));
    set = GetParam().set;
    stands_still = GetParam().stands_still;
    until(minutes(30));

    EXPECT_EQ(world.fleet->schedule(six)->made, 1);
    EXPECT_EQ(world.fleet->schedule(six)->skipped, 0);
    // 29 minutes by the watch; the server's may go a tenth faster or slower.
    EXPECT_GE(world.fleet->schedule(round)->made, 6);
    EXPECT_LE(world.fleet->schedule(round)->made, 9);
    for (const auto& event : world.store.events) {
        if (event.type == "vehicle.link") {
            EXPECT_EQ(std::get<std::string>(event.params.at(1).value), "live");
        }
        EXPECT_NE(event.type, "vehicle.needs_resume");
    }
    for (std::size_t i = 1; i < world.store.events.size(); ++i) {
        EXPECT_EQ(world.store.events[i].seq, world.store.events[i - 1].seq + 1);
        EXPECT_GE(world.store.events[i].at, world.store.events[i - 1].at);
    }
    int ended = 0;
    for (const auto& [id, order] : world.store.orders) {
        if (order.state == JobState::kEnded) ++ended;
    }
    EXPECT_GE(ended, 6);
}

INSTANTIATE_TEST_SUITE_P(Set, ClockSteps,
                         ::testing::Values(Step{"nothing", {}}, Step{"hour_on", hours(1)},
                                           Step{"hour_back", -hours(1)}, Step{"day_on", hours(24)},
                                           Step{"day_back", -hours(24)},
                                           Step{"to_1970", -hours(24 * 365 * 56)},
                                           Step{"stands_still", {}, true}),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace pulseline::fleet::testing
