#include "server/fleet_runtime.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>

#include "tests/server/memory_stores.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {
namespace {

using std::chrono::milliseconds;
using Steady = std::chrono::steady_clock;

const plant::VehicleId kVehicle("V1");
constexpr auto kPatience = std::chrono::seconds(60);  // of a busy machine; nothing waits for it

/// The runtime alone; this test's threads stand for the network thread.
class Runtime {
public:
    Runtime() {
        FleetRuntime::Ports ports{plant_, store, clock, metrics, {}, {}, [] {}};
        ports.deliver = [this](FleetRuntime::Job job) {
            if (deliver_throws > 0 && std::this_thread::get_id() != network_.get_id()) {
                --deliver_throws;
                throw std::bad_alloc();
            }
            const std::lock_guard lock(mutex_);
            jobs_.push_back(std::move(job));
            wake_.notify_all();
        };
        ports.publish = [this](const Published& batch) { publish(batch); };
        network_ = std::thread([this] { run(); });
        runtime.emplace(std::move(ports), 1);
        if (!runtime->start({})) throw std::runtime_error("did not start");
        begun_ = true;
    }
    ~Runtime() {
        store.go_on();
        runtime->stop();
        {
            const std::lock_guard lock(mutex_);
            over_ = true;
        }
        wake_.notify_all();
        network_.join();
    }

    template <class F>
    auto ask(F f, bool stops = false) {
        using R = std::invoke_result_t<F, fleet::Fleet&, Time>;
        auto promise = std::make_shared<std::promise<Result<R>>>();
        auto done = [promise](Result<R> result) { promise->set_value(std::move(result)); };
        if (stops) {
            runtime->stop_command(std::move(f), std::move(done));
        } else {
            runtime->command(std::move(f), std::move(done));
        }
        return promise->get_future();
    }
    template <class F>
    auto look(F f) {
        using R = std::invoke_result_t<F, fleet::Fleet&, Time>;
        auto promise = std::make_shared<std::promise<Result<R>>>();
        runtime->read(std::move(f),
                      [promise](Result<R> result) { promise->set_value(std::move(result)); });
        return promise->get_future();
    }
    void report() {
        runtime->input(kVehicle, [](fleet::Fleet& fleet, Time now) {
            fleet.vehicle_connected(kVehicle, now);
            fleet::StateMessage state;
            state.header_id = 1;
            state.position_initialized = true;
            state.pose = geometry::Pose2{5, 5, 0};
            state.map_id = "hall";
            fleet.vehicle_state(kVehicle, state, now);
        });
    }
    template <class F>
    bool until(F condition) {
        const auto end = Steady::now() + kPatience;
        while (!condition()) {
            if (Steady::now() > end) return false;
            std::this_thread::sleep_for(milliseconds(2));
        }
        return true;
    }
    int events(const std::string& type) {
        const auto all = store.all_events();
        return static_cast<int>(
            std::ranges::count_if(all, [&](const auto& event) { return event.type == type; }));
    }
    int sent(const std::string& action) {
        const std::lock_guard lock(mutex_);
        return static_cast<int>(std::ranges::count(actions_, action));
    }

    struct LateClock : Clock {
        std::atomic<std::int64_t> late_ns{0};
        Time now() const override {
            if (looks_left_ > 0 && --looks_left_ == 0) act_();
            return Time{Steady::now().time_since_epoch() + std::chrono::hours(24 * 365)} +
                   Duration(late_ns);
        }
        /// REQUIRES: the fleet thread. It asks for the time when it begins to wait, and when it has
        /// decided what to do.
        void between_two_looks(std::function<void()> act) {
            act_ = std::move(act);
            looks_left_ = 2;
        }

    private:
        std::function<void()> act_;
        mutable std::atomic<int> looks_left_{0};
    };

    MemoryStore store;
    LateClock clock;
    Metrics metrics;
    std::atomic<bool> publish_throws{false};
    std::atomic<int> deliver_throws{0};
    std::atomic<bool> deaf{false};
    std::atomic<int> pauses_shown{0};  // views of a fleet that is paused
    std::optional<FleetRuntime> runtime;

private:
    void publish(const Published& batch) {
        if (publish_throws) throw std::runtime_error("a dashboard's frame cannot be made");
        if (batch.fleet && batch.fleet->paused) ++pauses_shown;
        const std::lock_guard lock(mutex_);
        for (const auto& message : batch.outputs.messages) {
            if (!message.instant_actions) continue;
            for (const auto& action : message.instant_actions->actions)
                actions_.push_back(action.type);
        }
    }
    void run() {
        for (;;) {
            if (begun_ && !deaf) runtime->listening();
            FleetRuntime::Job job;
            {
                std::unique_lock lock(mutex_);
                wake_.wait_for(lock, milliseconds(50), [this] { return over_ || !jobs_.empty(); });
                if (jobs_.empty() && over_) return;
                if (jobs_.empty()) continue;
                job = std::move(jobs_.front());
                jobs_.pop_front();
            }
            job();
        }
    }

    plant::Plant plant_ = small_plant();
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<FleetRuntime::Job> jobs_;
    std::vector<std::string> actions_;
    bool over_ = false;
    std::atomic<bool> begun_{false};
    std::thread network_;
};

int pause_fleet(fleet::Fleet& fleet, Time now) {
    fleet.pause_fleet("person", now);
    return 1;
}
int resume_vehicle(fleet::Fleet& fleet, Time now) {
    return fleet.resume_fleet({kVehicle}, "person", now) ? 1 : 0;
}
int throws(fleet::Fleet&, Time) { throw std::runtime_error("a fault of the fleet"); }

TEST(FleetRuntime, WhatCannotBeShownKeepsNobodysAnswer) {
    Runtime server;
    server.publish_throws = true;

    auto paused = server.ask(pause_fleet);

    ASSERT_EQ(paused.wait_for(kPatience), std::future_status::ready);
    EXPECT_TRUE(paused.get());
}

TEST(FleetRuntime, OneThatThrowsCostsOthersNothing) {
    Runtime server;
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
    Runtime server;
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
    Runtime server;
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
    Runtime server;
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
    Runtime server;
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
    Runtime server;
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
    Runtime server;
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
    Runtime server;
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
    Runtime server;
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
        Runtime server;
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
    Runtime server;
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
    Runtime server;

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
    Runtime server;
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
