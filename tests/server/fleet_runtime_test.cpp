#include "server/runtime/fleet_runtime.hpp"

#include <gtest/gtest.h>

#include "tests/server/lone_runtime.hpp"

namespace pulseline::server::testing {
namespace {

int resume_vehicle(fleet::Fleet& fleet, Time now) {
    return fleet.resume_fleet({kVehicle}, "person", now) ? 1 : 0;
}
int throws(fleet::Fleet&, Time) { throw std::runtime_error("a fault of the fleet"); }

TEST(FleetRuntime, WhatCannotBeShownKeepsNobodysAnswer) {
    LoneRuntime server;
    server.publish_throws = true;

    auto paused = server.ask(pause_fleet);

    ASSERT_EQ(paused.wait_for(kPatience), std::future_status::ready);
    EXPECT_TRUE(paused.get());
}

TEST(FleetRuntime, OneThatThrowsCostsOthersNothing) {
    LoneRuntime server;
    // All three wait behind a slow one, so that they are one batch.
    auto first = server.ask([](fleet::Fleet&, Time) {
        std::this_thread::sleep_for(milliseconds(15));
        return 1;
    });
    auto before = server.ask(pause_fleet);
    auto faulty = server.ask(throws);
    auto after = server.ask(pause_fleet);

    EXPECT_TRUE(first.get());
    EXPECT_TRUE(before.get());
    const auto refused = faulty.get();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "internal");
    EXPECT_TRUE(after.get());
    EXPECT_EQ(server.events("fleet.paused"), 2);
}

TEST(FleetRuntime, AVehicleWhoseMessageThrowsIsNotListenedToForAWhileAndThenHeard) {
    LoneRuntime server;
    std::atomic<int> handled{0};
    std::atomic<bool> faulty{true};
    const auto say = [&] {
        server.runtime->input(kVehicle, [&](fleet::Fleet&, Time) {
            ++handled;
            if (faulty) throw std::runtime_error("a number nobody thought of");
        });
    };

    say();
    ASSERT_TRUE(server.until([&] { return server.metrics.fleet_rebuilds > 0; }));
    for (int i = 0; i < 20; ++i) say();
    ASSERT_TRUE(server.ask(pause_fleet).get());
    EXPECT_EQ(handled, 1);
    EXPECT_EQ(server.metrics.fleet_rebuilds, 1u);

    faulty = false;
    server.clock.late_ns = std::chrono::nanoseconds(std::chrono::seconds(2)).count();
    EXPECT_TRUE(server.until([&] { return handled > 1; }));
}

TEST(FleetRuntime, AFaultOfTheFleetThreadEndsInReadOnlyAndComesBack) {
    LoneRuntime server;
    // The answer to the fault cannot be handed over: the exception leaves the batch.
    for (int i = 0; i < 3; ++i) {
        server.deliver_throws = 1;
        server.runtime->command(throws, [](Result<int>) {});
        ASSERT_TRUE(server.until([&] { return server.deliver_throws == 0; }));
        ASSERT_TRUE(server.until(
            [&] { return server.metrics.fleet_faults >= static_cast<std::uint64_t>(i + 1); }));
    }

    ASSERT_TRUE(server.until([&] { return server.runtime->store_fault().has_value(); }));
    EXPECT_EQ(server.runtime->store_fault()->cause, "internal");
    EXPECT_FALSE(server.runtime->writable());
    EXPECT_TRUE(server.look([](fleet::Fleet& fleet, Time now) { return fleet.view(now); }).get());

    EXPECT_TRUE(server.until([&] { return server.runtime->writable(); }));
    EXPECT_TRUE(server.ask(pause_fleet).get());
}

TEST(FleetRuntime, AFaultOfTheCommitThreadIsOverByItself) {
    LoneRuntime server;
    // What is stored cannot be handed over.
    server.deliver_throws = 1;
    server.runtime->command(pause_fleet, [](Result<int>) {});

    ASSERT_TRUE(server.until([&] { return server.deliver_throws == 0; }));
    EXPECT_TRUE(server.until([&] { return server.events("fleet.paused") == 1; }));
    EXPECT_TRUE(server.until([&] { return server.metrics.fleet_rebuilds > 0; }));
    ASSERT_TRUE(server.until([&] { return server.runtime->writable(); }));
    EXPECT_TRUE(server.ask(pause_fleet).get());
}

TEST(FleetRuntime, AStallIsNobodysSilence) {
    LoneRuntime server;
    server.report();
    ASSERT_TRUE(server.until([&] { return server.events("vehicle.pose_confirmed") == 1; }));

    server.clock.late_ns = std::chrono::nanoseconds(std::chrono::seconds(30)).count();

    ASSERT_TRUE(server.until([&] { return server.events("server.stood_still") == 1; }));
    ASSERT_TRUE(server.ask(pause_fleet).get());
    for (const auto& event : server.store.all_events()) {
        EXPECT_FALSE(event.type == "vehicle.link" &&
                     event.params.back().value == ParamValue(std::string("lost")));
    }
}

TEST(FleetRuntime, NothingIsSilenceWhileTheSocketsAreNotRead) {
    LoneRuntime server;
    server.report();
    ASSERT_TRUE(server.until([&] { return server.events("vehicle.pose_confirmed") == 1; }));
    server.deaf = true;
    std::this_thread::sleep_for(milliseconds(1200));  // a stall of a thread is a matter of time
    const auto ticks_end = server.runtime->queues().tick_age_s;

    std::this_thread::sleep_for(milliseconds(1500));
    EXPECT_GT(server.runtime->queues().tick_age_s, ticks_end + 0.3);
    server.deaf = false;

    EXPECT_TRUE(server.until([&] { return server.events("server.stood_still") == 1; }));
    EXPECT_TRUE(server.until([&] { return server.runtime->queues().tick_age_s < 0.5; }));
}

/// Work of the fleet's thread, 300 times in the floods below.
constexpr auto kFiveMilliseconds = [](fleet::Fleet&, Time) {
    std::this_thread::sleep_for(milliseconds(5));
    return 1;
};

TEST(FleetRuntime, AFloodOfCommandsLeavesRoomForTicksAndReads) {
    LoneRuntime server;
    ASSERT_TRUE(server.until([&] { return server.runtime->queues().tick_age_s < 0.5; }));
    for (int i = 0; i < 300; ++i) {
        server.runtime->command(kFiveMilliseconds, [](Result<int>) {});
    }

    const auto begin = Steady::now();
    auto read = server.look([](fleet::Fleet& fleet, Time now) { return fleet.view(now); });

    // The whole flood takes 1.5 s at least.
    ASSERT_EQ(read.wait_for(kPatience), std::future_status::ready);
    EXPECT_LT(Steady::now() - begin, std::chrono::seconds(1));
    EXPECT_GT(server.runtime->queues().commands, 100u);
}

TEST(FleetRuntime, AFloodOfReadsLeavesRoomForTicksAndCommands) {
    LoneRuntime server;
    ASSERT_TRUE(server.until([&] { return server.runtime->queues().tick_age_s < 0.5; }));
    for (int i = 0; i < 300; ++i) {
        server.runtime->read(kFiveMilliseconds, [](Result<int>) {});
    }

    const auto begin = Steady::now();
    auto command = server.ask(pause_fleet);

    // The whole flood takes 1.5 s at least.
    ASSERT_EQ(command.wait_for(kPatience), std::future_status::ready);
    EXPECT_LT(Steady::now() - begin, std::chrono::seconds(1));
    EXPECT_GT(server.runtime->queues().reads, 100u);
}

TEST(FleetRuntime, ACommandThatHasWaitedTooLongChangesNothing) {
    LoneRuntime server;
    std::promise<void> go;
    auto first = server.ask([gone = go.get_future().share()](fleet::Fleet&, Time) {
        gone.wait();
        return 1;
    });
    auto second = server.ask(pause_fleet);
    std::this_thread::sleep_for(milliseconds(5200));  // how long it may wait is a matter of time
    go.set_value();

    EXPECT_TRUE(first.get());
    const auto late = second.get();
    ASSERT_FALSE(late);
    EXPECT_EQ(late.error().reason.code, "command_expired");
    EXPECT_EQ(server.events("fleet.paused"), 0);
}

TEST(FailedCommit, IsOfUnknownOutcomeUnlessTheDiskTookNothing) {
    for (const bool full : {false, true}) {
        LoneRuntime server;
        (full ? server.store.is_full : server.store.fails) = true;

        const auto caught = server.ask(pause_fleet).get();

        ASSERT_FALSE(caught);
        EXPECT_EQ(caught.error().reason.code, "store_unavailable");
        const auto& told = caught.error().what;
        EXPECT_EQ(told.find("Idempotency-Key") != std::string::npos, !full) << told;
        EXPECT_EQ(told.find("nothing was changed") != std::string::npos, full) << told;
    }
}

/// The fleet thread has decided what this turn is about, and not yet begun with it.
TEST(FailedCommit, BetweenTwoLooksOfTheFleetThreadIsToldAndNothingOfItIsShown) {
    LoneRuntime server;
    server.store.hang();
    auto lost = server.ask(pause_fleet);
    ASSERT_TRUE(server.until([&] { return server.runtime->queues().commits > 0; }));
    auto behind = server.ask([&](fleet::Fleet&, Time) {
        server.clock.between_two_looks([&] {
            server.store.fails = true;
            server.store.go_on();
            EXPECT_TRUE(server.until([&] { return !server.runtime->writable(); }));
            server.store.fails = false;
        });
        return 1;
    });

    EXPECT_FALSE(lost.get());
    EXPECT_FALSE(behind.get());
    ASSERT_TRUE(server.until([&] { return server.runtime->writable(); }));
    EXPECT_TRUE(server.until([&] { return server.events("store.recovered") == 1; }));
    EXPECT_EQ(server.events("store.failed"), 1);
    EXPECT_EQ(server.events("fleet.paused"), 0);
    EXPECT_EQ(server.pauses_shown, 0) << "what is not stored is shown";
}

struct HungDisk : ::testing::Test {
    LoneRuntime server;

    void SetUp() override {
        server.report();
        ASSERT_TRUE(server.until([&] { return server.events("vehicle.pose_confirmed") == 1; }));
        ASSERT_TRUE(server.ask(pause_fleet).get());
    }
};

TEST_F(HungDisk, RefusesCommandsWithinASecondAnswersReadsAndStopsVehicles) {
    server.store.hang();
    const auto begin = Steady::now();
    auto caught = server.ask([](fleet::Fleet& fleet, Time now) {
        return fleet.resume_fleet({kVehicle}, "person", now).has_value();
    });
    ASSERT_TRUE(server.until([&] { return !server.runtime->writable(); }));
    EXPECT_LT(Steady::now() - begin, std::chrono::seconds(3));
    EXPECT_EQ(server.runtime->store_fault()->cause, "disk_hangs");

    const auto refused = server.ask(pause_fleet).get();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "store_unavailable");
    EXPECT_TRUE(server.look([](fleet::Fleet& fleet, Time now) { return fleet.view(now); }).get());
    const int before = server.sent("startPause");
    const auto stopped = server.ask(pause_fleet, true).get();
    EXPECT_TRUE(stopped);
    EXPECT_TRUE(server.until([&] { return server.sent("startPause") > before; }));
    EXPECT_EQ(server.sent("stopPause"), 0) << "told before it was stored";

    const auto unknown = caught.get();
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().what.find("Idempotency-Key"), std::string::npos);
    server.store.go_on();
    ASSERT_TRUE(server.until([&] { return server.runtime->writable(); }));
    EXPECT_EQ(server.sent("stopPause"), 0) << "an act of before the disk hung was carried out";
    const auto vehicle =
        server.look([](fleet::Fleet& fleet, Time now) { return *fleet.vehicle(kVehicle, now); })
            .get();
    ASSERT_TRUE(vehicle);
    EXPECT_TRUE(vehicle->paused) << "the pause is not recorded";
    EXPECT_TRUE(vehicle->needs_resume);
    EXPECT_EQ(vehicle->needs_resume_reason.code, "command_expired");
}

TEST_F(HungDisk, LetsNothingPileUp) {
    server.store.hang();
    auto caught = server.ask(resume_vehicle);
    ASSERT_TRUE(server.until([&] { return !server.runtime->writable(); }));
    const auto held = server.runtime->queues().commits;

    // Its vehicles go on talking until the commit is given up.
    std::size_t most = 0;
    while (caught.wait_for(milliseconds(10)) != std::future_status::ready) {
        server.report();
        most = std::max(most, server.runtime->queues().commits);
    }

    EXPECT_LE(most, held);
    EXPECT_TRUE(server.until([&] { return server.runtime->queues().commands == 0; }));
}

TEST_F(HungDisk, WhoseHangIsShortCostsNothing) {
    server.store.hang();
    auto caught = server.ask(resume_vehicle);
    ASSERT_TRUE(server.until([&] { return !server.runtime->writable(); }));
    server.store.go_on();

    const auto resumed = caught.get();

    ASSERT_TRUE(resumed);
    EXPECT_EQ(*resumed, 1);
    ASSERT_TRUE(server.until([&] { return server.runtime->writable(); }));
    EXPECT_TRUE(server.until([&] { return server.sent("stopPause") == 1; }));
    EXPECT_EQ(server.metrics.fleet_rebuilds, 0u);
}

TEST(FullDisk, StopsVehiclesAtOnceAndStoresThatWhenItCan) {
    LoneRuntime server;
    server.report();
    ASSERT_TRUE(server.until([&] { return server.events("vehicle.pose_confirmed") == 1; }));
    server.store.fails = true;
    ASSERT_FALSE(server.ask(resume_vehicle).get());

    const auto stopped = server.ask(pause_fleet, true).get();

    EXPECT_TRUE(stopped);
    EXPECT_TRUE(server.until([&] { return server.sent("startPause") > 0; }));
    EXPECT_EQ(server.events("fleet.paused"), 0);
    server.store.fails = false;
    ASSERT_TRUE(server.until([&] { return server.runtime->writable(); }));
    EXPECT_TRUE(server.until([&] { return server.events("fleet.paused") == 1; }));
    const auto view =
        server.look([](fleet::Fleet& fleet, Time now) { return fleet.view(now); }).get();
    ASSERT_TRUE(view);
    EXPECT_TRUE(view->paused);
}

}  // namespace
}  // namespace pulseline::server::testing
