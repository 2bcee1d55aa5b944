#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/server/lone_runtime.hpp"

// Eight threads ask the runtime for everything at once while its store fails, fills up and hangs.
// The thread sanitizer watches it for five minutes (./dev nightly tsan).
//   PULSELINE_STRESS_S  seconds, 3 without it
namespace pulseline::server::testing {
namespace {

Duration stress_time() {
    const char* told = std::getenv("PULSELINE_STRESS_S");
    return std::chrono::seconds(told ? std::max(1, std::atoi(told)) : 3);
}

bool make_order(fleet::Fleet& fleet, const std::string& name, Time now) {
    fleet::NewOrder order;
    order.client_order_id = name;
    order.steps.push_back({2, plant::MotionMode::kAuto});
    return fleet.create(order, now).has_value();
}

int throws(fleet::Fleet&, Time) { throw std::runtime_error("a fault of the fleet"); }

class Crowd {
public:
    ~Crowd() {
        for (auto& thread : threads_) thread.join();
    }

    /// Does that again and again on a thread of its own, each time with another number.
    void keep_doing(std::function<void(int)> act) {
        threads_.emplace_back([this, act = std::move(act)] {
            for (int i = 0; Steady::now() < end_; ++i) act(i);
        });
    }
    bool is_over() const { return Steady::now() >= end_; }
    /// Every question has one answer: a second one ends the process (std::future_error).
    template <class Future>
    auto answer_to(Future asked) {
        EXPECT_EQ(asked.wait_for(kPatience), std::future_status::ready);
        ++answers;
        return asked.get();
    }

    std::atomic<int> answers{0};

private:
    Steady::time_point end_ = Steady::now() + stress_time();
    std::vector<std::thread> threads_;
};

TEST(RuntimeStress, EightThreadsGetEachAnswerOnceAndLoseNothingThatWasAcknowledged) {
    LoneRuntime server;
    std::atomic<int> pauses{0};
    std::atomic<int> orders{0};
    std::atomic<int> refused{0};
    {
        Crowd crowd;
        for (int thread = 0; thread < 2; ++thread) {
            crowd.keep_doing([&](int) {
                server.report();
                std::this_thread::yield();
                if (server.runtime->queues().commands > 1000)
                    crowd.answer_to(server.look([](fleet::Fleet&, Time) { return 1; }));
            });
            crowd.keep_doing([&, thread](int i) {
                const auto name = std::to_string(thread) + "-" + std::to_string(i);
                const auto made = crowd.answer_to(server.ask([name](fleet::Fleet& fleet, Time now) {
                    return make_order(fleet, name, now);
                }));
                if (!made) ++refused;
                if (made && *made) ++orders;
            });
        }
        crowd.keep_doing([&](int) {
            if (crowd.answer_to(server.ask(pause_fleet, true))) ++pauses;
        });
        crowd.keep_doing([&](int) {
            const auto seen = crowd.answer_to(
                server.look([](fleet::Fleet& fleet, Time now) { return fleet.view(now); }));
            EXPECT_TRUE(seen) << seen.error().reason.code << ": " << seen.error().what;
        });
        crowd.keep_doing([&](int) {
            try {
                server.runtime->write([] {});
            } catch (const StoreUnavailable&) {
                ++refused;
            }
        });
        crowd.keep_doing([&](int i) {
            if (i % 100 == 0) crowd.answer_to(server.ask(throws));
            static_cast<void>(server.runtime->writable());
            static_cast<void>(server.runtime->store_fault());
            static_cast<void>(server.runtime->queues());
            std::this_thread::sleep_for(milliseconds(1));
        });
        for (int fault = 0; !crowd.is_over(); ++fault) {
            std::this_thread::sleep_for(milliseconds(700));
            if (fault % 3 == 0) server.store.fails = true;
            if (fault % 3 == 1) server.store.is_full = true;
            if (fault % 3 == 2) server.store.hang();
            std::this_thread::sleep_for(milliseconds(fault % 6 == 5 ? 6000 : 100));
            server.store.fails = server.store.is_full = false;
            server.store.go_on();
        }
    }
    ASSERT_TRUE(server.until([&] { return server.runtime->writable(); }));
    EXPECT_TRUE(server.ask(pause_fleet).get());
    EXPECT_GT(pauses, 0);
    EXPECT_GT(orders, 0);
    EXPECT_GT(refused, 0) << "no store failed";
    EXPECT_GE(server.store.order_count(), static_cast<std::size_t>(orders));
    EXPECT_GT(server.events("fleet.paused"), pauses);
}

}  // namespace
}  // namespace pulseline::server::testing
