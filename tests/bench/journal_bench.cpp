// ./dev bench journal: what a journal and a snapshot weigh and cost, for fleets of some sizes at
// work, every vehicle on an order on its own lane.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "tests/bench/lanes.hpp"
#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet {
namespace {

// Of the processor: what others do on the machine does not count.
double now_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double ms_since(double start_ms) { return now_ms() - start_ms; }

/// What a week leaves in memory.
void add_finished(testing::World& world, int count) {
    StoredFleet stored;
    IdSource ids(5);
    for (int i = 1; i <= count; ++i) {
        JobOrder order;
        order.id = JobOrderId(ids.next(world.now));
        order.number = i;
        order.client_order_id = "past-" + std::to_string(i);
        order.wanted_vehicle = order.assigned_vehicle = world.plant.vehicles.front().id;
        order.steps.resize(2);
        for (auto& step : order.steps) {
            step.station = world.plant.stations.front().id;
            step.leg = LegId(ids.next(world.now));
            step.stop = StopRecordId(ids.next(world.now));
            step.state = StepState::kDone;
        }
        order.state = JobState::kEnded;
        order.created_by = "mes";
        order.created = order.started = order.ended = world.now;
        stored.orders.push_back(std::move(order));
    }
    stored.last_order_number = count;
    world.fleet = std::make_unique<Fleet>(world.plant, std::move(stored), 1, world.now);
}

void measure(int count, int finished = 0) {
    testing::World world(bench::lanes(count));
    if (finished > 0) add_finished(world, finished);
    journal::Recorder recorder;
    world.fleet->journal_into(&recorder);
    world.connect_all();
    world.run(2);
    for (int i = 0; i < count; ++i) {
        const auto made = world.order("V" + std::to_string(i + 1), {2 * i + 2, 2 * i + 1});
        if (!made) std::printf("order refused: %s\n", made.error().what.c_str());
    }
    world.run(5);
    static_cast<void>(world.fleet->take_outputs(world.now));
    const auto inputs = recorder.inputs();
    const std::string written = recorder.take();
    constexpr int kRounds = 20;
    std::string bytes;
    double worst_ms = 0;
    const auto start = now_ms();
    for (int i = 0; i < kRounds; ++i) {
        const auto one = now_ms();
        bytes = world.fleet->snapshot();
        worst_ms = std::max(worst_ms, ms_since(one));
    }
    const double snapshot_ms = ms_since(start) / kRounds;
    const auto from = now_ms();
    const auto restored = Fleet::from_snapshot(world.plant, bytes);
    const double restore_ms = ms_since(from);
    const bool same = restored && (*restored)->snapshot() == bytes;
    std::printf(
        "{\"vehicles\":%d,\"finished_orders\":%d,\"inputs\":%u,\"bytes_per_input\":%.0f,\"snapshot_"
        "bytes\":%zu,"
        "\"snapshot_ms\":%.2f,\"snapshot_max_ms\":%.2f,\"restore_ms\":%.0f,\"same\":%s}\n",
        count, finished, inputs, static_cast<double>(written.size()) / inputs, bytes.size(),
        snapshot_ms, worst_ms, restore_ms, same ? "true" : "false");
}

}  // namespace
}  // namespace pulseline::fleet

int main(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        if (std::atoi(argv[i]) > 0) pulseline::fleet::measure(std::atoi(argv[i]));
    }
    if (argc > 1 && std::atoi(argv[argc - 1]) > 0) return 0;
    for (const int count : {12, 100, 1000}) pulseline::fleet::measure(count);
    pulseline::fleet::measure(12, 100'000);
}
