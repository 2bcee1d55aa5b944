// Simulation judge of core/traffic: many seeds, each a random plant with random faults; every law
// is checked at every step. A seed that fails prints itself; `--seed N` replays it identically.
//   test_traffic_judge [--seeds N] [--first N] [--hours H] [--seed N]
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

#include "tests/simulation/judge_world.hpp"

namespace pulseline::judge {
namespace {

struct Arguments {
    std::uint64_t first = 1;
    std::uint64_t seeds = 300;
    double hours = 1;
    bool one = false;
};

Arguments arguments_from(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        const char* value = argv[i + 1];
        if (name == "--seeds") {
            arguments.seeds = std::strtoull(value, nullptr, 10);
        } else if (name == "--first") {
            arguments.first = std::strtoull(value, nullptr, 10);
        } else if (name == "--hours") {
            arguments.hours = std::strtod(value, nullptr);
        } else if (name == "--seed") {
            arguments.first = std::strtoull(value, nullptr, 10);
            arguments.seeds = 1;
            arguments.one = true;
        } else {
            std::fprintf(stderr, "unknown option %s\n", name.c_str());
            std::exit(2);
        }
    }
    return arguments;
}

bool is_fault(const std::string& event) {
    return event.rfind("vehicle ", 0) == 0 || event == "floor closed" || event == "restart";
}

int run(const Arguments& arguments) {
    std::map<std::string, std::uint64_t> events;
    std::map<std::string, std::uint64_t> seeds_with;
    std::uint64_t failed = 0;
    std::uint64_t with_faults = 0;
    std::uint64_t orders = 0;
    std::uint64_t grants = 0;
    double hours = 0;
    int least_vehicles = 1000;
    int most_vehicles = 0;
    for (std::uint64_t seed = arguments.first; seed < arguments.first + arguments.seeds; ++seed) {
        const Outcome outcome = judge_seed(seed, {arguments.hours * 3600, 6 * 3600, arguments.one});
        bool fault = false;
        for (const auto& [name, count] : outcome.events) {
            events[name] += static_cast<std::uint64_t>(count);
            ++seeds_with[name];
            fault |= is_fault(name);
        }
        with_faults += fault ? 1 : 0;
        orders += static_cast<std::uint64_t>(outcome.orders);
        grants += outcome.grants;
        hours += outcome.end_s / 3600;
        least_vehicles = std::min(least_vehicles, outcome.vehicles);
        most_vehicles = std::max(most_vehicles, outcome.vehicles);
        if (arguments.one) {
            std::printf("seed %llu: digest %016llx\n", static_cast<unsigned long long>(seed),
                        static_cast<unsigned long long>(outcome.digest));
        }
        if (outcome.violations.empty()) continue;
        ++failed;
        for (const std::string& violation : outcome.violations) {
            std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed),
                        violation.c_str());
        }
        std::printf("replay: test_traffic_judge --seed %llu --hours %g\n",
                    static_cast<unsigned long long>(seed), arguments.hours);
        std::fflush(stdout);
    }
    const auto share =
        100.0 * static_cast<double>(with_faults) / static_cast<double>(arguments.seeds);
    std::printf("%llu seeds, %.0f simulated hours, %d to %d vehicles, %llu orders, %llu grants\n",
                static_cast<unsigned long long>(arguments.seeds), hours, least_vehicles,
                most_vehicles, static_cast<unsigned long long>(orders),
                static_cast<unsigned long long>(grants));
    for (const auto& [name, count] : events) {
        std::printf("  %-32s %8llu in %llu seeds\n", name.c_str(),
                    static_cast<unsigned long long>(count),
                    static_cast<unsigned long long>(seeds_with[name]));
    }
    std::printf("faults in %.0f %% of the seeds; %llu seeds failed\n", share,
                static_cast<unsigned long long>(failed));
    std::printf("# pass %llu\n# fail %llu\n",
                static_cast<unsigned long long>(arguments.seeds - failed),
                static_cast<unsigned long long>(failed));
    if (arguments.seeds >= 100 && share < 80) {
        std::printf("too few seeds have faults\n");
        return 1;
    }
    return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pulseline::judge

int main(int argc, char** argv) {
    return pulseline::judge::run(pulseline::judge::arguments_from(argc, argv));
}
