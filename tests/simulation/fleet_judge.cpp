// Simulation judge of the whole fleet: many seeds, each a random plant with the real fleet, real
// vehicle executors and random faults. A seed that fails prints itself and its last events;
// `--seed N` replays it identically, which every tenth seed proves. With --journal a second fleet
// follows the first one's snapshots and journal, byte for byte.
//   test_fleet_judge [--seeds N] [--first N] [--hours H] [--seed N] [--trace 1] [--journal 1]
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/simulation/fleet_judge_world.hpp"

namespace pulseline::fleet_judge {
namespace {

constexpr std::uint64_t kReplayEvery = 10;

struct Arguments {
    std::uint64_t first = 1;
    std::uint64_t seeds = 100;
    bool one = false;
    Options options;
};

Arguments arguments_from(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const char* value = argv[i + 1];
        if (name == "--seeds") {
            arguments.seeds = std::strtoull(value, nullptr, 10);
        } else if (name == "--first" || name == "--seed") {
            arguments.first = std::strtoull(value, nullptr, 10);
            arguments.one = name == "--seed";
            if (arguments.one) arguments.seeds = 1;
        } else if (name == "--hours") {
            arguments.options.hours = std::strtod(value, nullptr);
        } else if (name == "--trace") {
            arguments.options.trace = *value == '1';
        } else if (name == "--journal") {
            arguments.options.journal = *value == '1';
        } else {
            std::fprintf(stderr, "unknown option %s\n", name.c_str());
            std::exit(2);
        }
    }
    return arguments;
}

struct Sums {
    std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> faults;  // times, seeds
    std::uint64_t with_faults = 0;
    std::uint64_t failed = 0;
    std::uint64_t replayed = 0;
    std::uint64_t orders = 0;
    std::uint64_t ended = 0;
    int fewest_orders = 1 << 30;
    int least = 1 << 30;
    int most = 0;
    double hours = 0;
    std::uint64_t inputs = 0;
    std::uint64_t input_bytes = 0;
    std::uint64_t snapshots = 0;
    std::uint64_t snapshot_bytes = 0;

    void add(const Outcome& outcome) {
        for (const auto& [name, count] : outcome.faults) {
            faults[name].first += static_cast<std::uint64_t>(count);
            ++faults[name].second;
        }
        with_faults += outcome.faults.empty() ? 0 : 1;
        orders += static_cast<std::uint64_t>(outcome.orders);
        ended += static_cast<std::uint64_t>(outcome.ended);
        fewest_orders = std::min(fewest_orders, outcome.orders);
        least = std::min(least, outcome.vehicles);
        most = std::max(most, outcome.vehicles);
        hours += outcome.end_s / 3600;
        inputs += outcome.inputs;
        input_bytes += outcome.input_bytes;
        snapshots += outcome.snapshots;
        snapshot_bytes += outcome.snapshot_bytes;
    }
};

void print_failure(std::uint64_t seed, const Outcome& outcome, const Options& options) {
    const auto number = static_cast<unsigned long long>(seed);
    for (const auto& event : outcome.last_events) std::printf("    %s\n", event.c_str());
    for (const auto& violation : outcome.violations) {
        std::printf("seed %llu: %s\n", number, violation.c_str());
    }
    std::printf("replay: test_fleet_judge --seed %llu --hours %g --trace 1\n", number,
                options.hours);
    std::fflush(stdout);
}

void judge(std::uint64_t seed, const Arguments& arguments, Sums& sums) {
    Outcome outcome = judge_seed(seed, arguments.options);
    if (arguments.one) {
        std::printf("seed %llu: digest %016llx, %d vehicles, %d orders, %.0f s\n",
                    static_cast<unsigned long long>(seed),
                    static_cast<unsigned long long>(outcome.digest), outcome.vehicles,
                    outcome.orders, outcome.end_s);
    }
    if (!arguments.one && (!outcome.violations.empty() || seed % kReplayEvery == 0)) {
        ++sums.replayed;
        const Outcome again = judge_seed(seed, arguments.options);
        if (again.digest != outcome.digest || again.violations != outcome.violations) {
            outcome.violations.push_back("its replay went another way");
        }
    }
    sums.add(outcome);
    if (outcome.violations.empty()) return;
    ++sums.failed;
    print_failure(seed, outcome, arguments.options);
}

int run(const Arguments& arguments) {
    Sums sums;
    for (std::uint64_t i = 0; i < arguments.seeds; ++i) judge(arguments.first + i, arguments, sums);
    const auto share =
        100.0 * static_cast<double>(sums.with_faults) / static_cast<double>(arguments.seeds);
    std::printf(
        "%llu seeds, %.0f simulated hours, %d to %d vehicles, %llu orders (at least %d a "
        "seed), %llu ended, %llu seeds replayed\n",
        static_cast<unsigned long long>(arguments.seeds), sums.hours, sums.least, sums.most,
        static_cast<unsigned long long>(sums.orders), sums.fewest_orders,
        static_cast<unsigned long long>(sums.ended),
        static_cast<unsigned long long>(sums.replayed));
    for (const auto& [name, counts] : sums.faults) {
        std::printf("  %-40s %8llu in %llu seeds\n", name.c_str(),
                    static_cast<unsigned long long>(counts.first),
                    static_cast<unsigned long long>(counts.second));
    }
    if (sums.snapshots > 0) {
        std::printf(
            "journal: %llu inputs replayed, %.0f bytes each; %llu snapshots of %.0f bytes\n",
            static_cast<unsigned long long>(sums.inputs),
            static_cast<double>(sums.input_bytes) / static_cast<double>(sums.inputs),
            static_cast<unsigned long long>(sums.snapshots),
            static_cast<double>(sums.snapshot_bytes) / static_cast<double>(sums.snapshots));
    }
    std::printf("faults in %.0f %% of the seeds; %llu seeds failed\n", share,
                static_cast<unsigned long long>(sums.failed));
    std::printf("# pass %llu\n# fail %llu\n",
                static_cast<unsigned long long>(arguments.seeds - sums.failed),
                static_cast<unsigned long long>(sums.failed));
    if (arguments.seeds >= 100 && share < 80) {
        std::printf("too few seeds have faults\n");
        return 1;
    }
    return sums.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pulseline::fleet_judge

int main(int argc, char** argv) {
    return pulseline::fleet_judge::run(pulseline::fleet_judge::arguments_from(argc, argv));
}
