#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>

#include "server/runtime/fleet_runtime.hpp"
#include "tests/server/memory_stores.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {

using std::chrono::milliseconds;
using Steady = std::chrono::steady_clock;

inline const plant::VehicleId kVehicle("V1");
inline constexpr auto kPatience =
    std::chrono::seconds(60);  // of a busy machine; nothing waits for it

/// The runtime alone on a store in memory; a thread of its own stands for the network thread.
class LoneRuntime {
public:
    LoneRuntime() {
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
    ~LoneRuntime() {
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
            vda5050::StateMessage state;
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

inline int pause_fleet(fleet::Fleet& fleet, Time now) {
    fleet.pause_fleet("person", now);
    return 1;
}

}  // namespace pulseline::server::testing
