#include "tests/bench/fleet_core_run.hpp"

#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>
#include <string>

#include "db/fleet/fleet_store.hpp"
#include "tests/bench/lanes.hpp"
#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTicksPerReport = 10;  // of 0.1 s: one report a second and vehicle
constexpr int kReportsPerNode = 5;   // a node takes five seconds
constexpr double kOrdersPerTick = 0.3;

double us_since(Clock::time_point start) {
    return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "pulseline-bench-XXXXXX");
        if (::mkdtemp(name.data()) == nullptr) std::abort();
        path_ = name;
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string file(const char* name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

class Core {
public:
    explicit Core(int vehicles) : world_(lanes(vehicles)) {
        for (auto& [id, vehicle] : world_.vehicles) {
            vehicle.state.position_initialized = true;
            world_.fleet->vehicle_connected(id, world_.now);
            free_.push_back(id);
        }
        settle(Clock::now());
    }

    CoreRun run(double seconds) {
        for (int warm_up = 0; warm_up < kTicksPerReport; ++warm_up) tick();
        run_ = {};
        const int ticks = static_cast<int>(seconds * 10);
        for (int i = 0; i < ticks; ++i) {
            tick();
            for (due_ += kOrdersPerTick; due_ >= 1 && !free_.empty(); --due_) order();
        }
        return std::move(run_);
    }

private:
    void tick() {
        world_.now += std::chrono::milliseconds(100);
        ++ticks_;
        int number = 0;
        for (auto& [id, vehicle] : world_.vehicles) {
            if ((ticks_ + number++) % kTicksPerReport != 0) continue;
            if ((ticks_ / kTicksPerReport + number) % kReportsPerNode == 0) vehicle.step();
            const auto start = Clock::now();
            world_.fleet->vehicle_state(id, vehicle.state, world_.now);
            settle(start);
        }
        const auto start = Clock::now();
        world_.fleet->tick(world_.now);
        settle(start);
    }

    /// There and back for the vehicle that has waited longest.
    void order() {
        const auto id = free_.front();
        free_.pop_front();
        const int number = std::stoi(id.str().substr(1));
        fleet::NewOrder request;
        request.actor = "mes";
        request.vehicle = id;
        for (const int station : {2 * number, 2 * number - 1})
            request.steps.push_back({station, plant::MotionMode::kAuto});
        const auto start = Clock::now();
        if (world_.fleet->create(request, world_.now)) ++run_.orders;
        settle(start);
    }

    void settle(Clock::time_point start) {
        ++run_.inputs;
        fleet::Outputs out = world_.fleet->take_outputs(world_.now);
        const double decided_us = us_since(start);
        if (out.records.empty() && out.messages.empty()) return;
        store_.commit(out.records);
        const double stored_us = us_since(start);
        for (const auto& order : out.records.orders) {
            if (order.state == fleet::JobState::kEnded) free_.push_back(order.assigned_vehicle);
        }
        const auto releases = [](const auto& message) { return message.order.has_value(); };
        if (std::ranges::any_of(out.messages, releases)) {
            run_.decided_us.push_back(decided_us);
            run_.stored_us.push_back(stored_us);
        }
        for (const auto& message : out.messages)
            world_.vehicles.at(message.vehicle).receive(message);
    }

    fleet::testing::World world_;
    Folder folder_;
    db::Database database_{folder_.file("bench.db")};
    db::FleetStore store_{database_};
    std::deque<plant::VehicleId> free_;
    double due_ = 0;
    int ticks_ = 0;
    CoreRun run_;
};

}  // namespace

CoreRun run_core(int vehicles, double seconds) { return Core(vehicles).run(seconds); }

}  // namespace pulseline::bench
