// `./dev bench fleet`: traffic at its size. Per setting: time of an admission and of a release
// decision, orders per simulated hour beside the bound of vehicles that never meet, and against two
// baselines on the same floor with the same orders (one vehicle per resource, and a joint plan
// after PIBT), vehicles that did not end their orders, memory, time of a rebuild, and what the
// independent monitor found. Admissions, improvements and rebuilds are measured in CPU time of the
// thread, release decisions by the wall clock. Last, the whole state machine of a thousand vehicles
// on a database file: releases as decided and as stored.
//   bench_fleet [--hours H] [--releases N] [--only halls|plant|warehouse|core] [--busy SHARE]
//               [--out FILE]
// H simulated hours a setting; with N the last setting goes on until all together made N releases.
// SHARE of the vehicles get orders: how much of the bound is lost to the floor being full.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/fleet_core_run.hpp"
#include "tests/bench/traffic_world.hpp"

namespace pulseline::bench {
namespace {

constexpr double kAdmissionLimit_us = 20'000;
constexpr double kReleaseLimit_us = 1'000;

struct Options {
    double hours = 0.25;
    std::uint64_t releases = 0;
    std::string only;
    double busy = 1;
    std::string out = "build/bench/fleet.json";
};

Options options_from(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; i += 2) {
        const std::string name = argv[i];
        const char* value = i + 1 < argc ? argv[i + 1] : "";
        if (name == "--hours") {
            options.hours = std::strtod(value, nullptr);
        } else if (name == "--releases") {
            options.releases = std::strtoull(value, nullptr, 10);
        } else if (name == "--busy") {
            options.busy = std::strtod(value, nullptr);
        } else if (name == "--only") {
            options.only = value;
        } else if (name == "--out") {
            options.out = value;
        } else if (name != "--benchmark_out_format=json" &&
                   name.rfind("--benchmark_out=", 0) != 0) {
            std::fprintf(stderr, "unknown option %s\n", argv[i]);
            std::exit(2);
        } else {
            --i;  // `./dev bench` names the file to all benchmarks in Google Benchmark's way
            if (name.rfind("--benchmark_out=", 0) == 0) options.out = name.substr(16);
        }
    }
    return options;
}

nlohmann::json quantiles(std::vector<double>& times_us) {
    return {{"count", times_us.size()},
            {"p50_us", quantile(times_us, 0.5)},
            {"p99_us", quantile(times_us, 0.99)},
            {"max_us", quantile(times_us, 1.0)}};
}

void print_times(const char* name, std::vector<double>& times_us, double limit_us) {
    const double p99_us = quantile(times_us, 0.99);
    std::printf("  %-18s p50 %9.1f us, p99 %9.1f us, max %9.1f us  (%zu)%s\n", name,
                quantile(times_us, 0.5), p99_us, quantile(times_us, 1.0), times_us.size(),
                limit_us > 0 && p99_us >= limit_us ? "  OVER THE LIMIT" : "");
}

nlohmann::json print_throughput(const char* name, const Run& run) {
    std::printf("  %-28s %8.0f orders/h  (%llu done, %d vehicles stuck", name,
                run.orders_per_hour(), static_cast<unsigned long long>(run.orders), run.stuck);
    if (run.longest_order_s > 0) std::printf(", longest order %.0f s", run.longest_order_s);
    const double mean_s = run.orders > 0 ? run.sum_order_s / static_cast<double>(run.orders) : 0;
    if (mean_s > 0) std::printf(", mean %.0f s", mean_s);
    std::printf(")\n");
    return {{"orders_per_hour", run.orders_per_hour()},
            {"orders", run.orders},
            {"stuck", run.stuck},
            {"longest_order_s", run.longest_order_s},
            {"mean_order_s", mean_s}};
}

struct Totals {
    std::uint64_t releases = 0;
    std::uint64_t failures = 0;
};

/// The baselines on the same floor with the same orders and one holder of each piece of floor; none
/// may be better.
void compare(const World& world, const Run& ours, nlohmann::json& json, Totals& totals) {
    const auto beaten = [&](const Run& other) { return other.orders > ours.orders ? 1U : 0U; };
    const Run exclusive = run_exclusive_legs(world, ours.simulated_s);
    json["one_vehicle_per_resource"] = print_throughput("one vehicle per resource", exclusive);
    totals.failures += world.real_plant ? 0 : beaten(exclusive);
    const auto pibt = run_pibt(world, ours.simulated_s, true);
    if (!pibt) {
        std::printf("  PIBT does not apply: the vehicles differ in size or their moves in time\n");
        return;
    }
    json["pibt_one_holder"] = print_throughput("PIBT, one holder a place", *pibt);
    totals.failures += beaten(*pibt);
    json["pibt"] = print_throughput("PIBT, two at once", *run_pibt(world, ours.simulated_s, false));
}

nlohmann::json measure(World world, const Options& options, std::uint64_t releases,
                       Totals& totals) {
    for (std::size_t v = 0; v < world.vehicles.size(); ++v) {
        world.vehicles[v].busy = static_cast<double>(v % 10) < 10 * options.busy;
    }
    std::printf("%s: %zu vehicles, layout %s\n", world.name.c_str(), world.vehicles.size(),
                world.well_formed ? "well-formed" : "NOT well-formed");
    std::fflush(stdout);
    Run ours = run_traffic(world, options.hours * 3600, releases);
    nlohmann::json json{{"vehicles", world.vehicles.size()},
                        {"well_formed", world.well_formed},
                        {"simulated_s", ours.simulated_s},
                        {"drained_s", ours.drained_s},
                        {"admission", quantiles(ours.admission_us)},
                        {"release_decision", quantiles(ours.release_us)},
                        {"improvement_step", quantiles(ours.improve_us)},
                        {"refused", ours.refused},
                        {"releases", ours.releases},
                        {"violations", ours.violations},
                        {"bytes_per_vehicle", ours.bytes_per_vehicle},
                        {"record_ms", ours.record_ms},
                        {"rebuild_ms", ours.rebuild_ms},
                        {"rebuilt_same", ours.rebuilt_same}};
    json["joint_plan"] = print_throughput("joint plan (this library)", ours);
    const Run alone = run_alone(world, ours.simulated_s);
    json["conflict_free_bound"] = print_throughput("each vehicle alone (bound)", alone);
    json["share_of_bound"] = ours.orders_per_hour() / alone.orders_per_hour();
    std::printf("  the joint plan ends %.1f %% of the bound\n",
                100 * ours.orders_per_hour() / alone.orders_per_hour());
    json["floor_capacity"] = floor_capacity(world);
    const double capacity = json["floor_capacity"];
    std::printf("  %-28s %8.0f orders/h; the joint plan ends %.1f %% of it\n",
                "what the floor lets through", capacity, 100 * ours.orders_per_hour() / capacity);
    if (options.busy == 1) compare(world, ours, json, totals);
    print_times("admission", ours.admission_us, kAdmissionLimit_us);
    print_times("release decision", ours.release_us, kReleaseLimit_us);
    print_times("improvement step", ours.improve_us, 0);
    std::printf(
        "  admissions refused and tried again: %s; all at rest %.0f s after the last order\n",
        ours.refused.empty() ? "none" : nlohmann::json(ours.refused).dump().c_str(),
        ours.drained_s);
    std::printf(
        "  %llu releases, %llu violations; %.1f KB a vehicle; record %.1f ms, rebuild %.1f ms%s\n",
        static_cast<unsigned long long>(ours.releases),
        static_cast<unsigned long long>(ours.violations), ours.bytes_per_vehicle / 1024,
        ours.record_ms, ours.rebuild_ms, ours.rebuilt_same ? "" : ", NOT THE SAME STATE");
    std::fflush(stdout);
    totals.releases += ours.releases;
    totals.failures += ours.violations + static_cast<std::uint64_t>(ours.stuck) +
                       (ours.rebuilt_same && (world.well_formed || world.real_plant) ? 0 : 1);
    return json;
}

nlohmann::json measure_core() {
    constexpr int kVehicles = 1000;
    constexpr double kSeconds = 120;
    CoreRun run = run_core(kVehicles, kSeconds);
    std::printf("core: state machine of %d vehicles, %llu inputs, %llu orders\n", kVehicles,
                static_cast<unsigned long long>(run.inputs),
                static_cast<unsigned long long>(run.orders));
    print_times("release decided", run.decided_us, kReleaseLimit_us);
    print_times("release stored", run.stored_us, 0);
    return {{"vehicles", kVehicles},
            {"inputs", run.inputs},
            {"orders", run.orders},
            {"release_decided", quantiles(run.decided_us)},
            {"release_stored", quantiles(run.stored_us)}};
}

}  // namespace
}  // namespace pulseline::bench

int main(int argc, char** argv) {
    using namespace pulseline::bench;
    const Options options = options_from(argc, argv);
    nlohmann::json json;
    Totals totals;
    const auto wanted = [&](const char* name) {
        return options.only.empty() || options.only == name;
    };
    const auto rest = [&] {
        return options.releases > totals.releases ? options.releases - totals.releases : 0;
    };
    if (wanted("halls")) {
        json["halls"] =
            measure(halls_world(), options, options.only == "halls" ? rest() : 0, totals);
    }
    if (wanted("plant")) {
        json["plant"] = measure(plant_world(PULSELINE_FLEET_PLANT), options, 0, totals);
    }
    if (wanted("warehouse")) {
        json["warehouse"] = measure(warehouse_world(), options, rest(), totals);
    }
    if (wanted("core")) json["core"] = measure_core();
    std::printf(
        "%llu releases in all; %llu violations, vehicles stuck, states not rebuilt or\n"
        "baselines that were better\n",
        static_cast<unsigned long long>(totals.releases),
        static_cast<unsigned long long>(totals.failures));
    const std::filesystem::path path(options.out);
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << json.dump(2) << "\n";
    std::printf("written to %s\n", options.out.c_str());
    return totals.failures == 0 ? 0 : 1;
}
