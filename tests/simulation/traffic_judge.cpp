// Simulation judge of core/traffic: many seeds, each a random plant with random faults; every law
// is checked at every step. A seed that fails prints itself; `--seed N` replays it identically.
//   test_traffic_judge [--seeds N] [--first N] [--hours H] [--seed N]
//   test_traffic_mutations [--seeds N]     (built with planted bugs: each must be found)
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <string>

#include "core/traffic/mutation.hpp"
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

#ifdef PULSELINE_MUTATIONS

constexpr unsigned kSecondsPerMutation = 60;

/// Runs seeds in a child process until one fails, since a planted bug may crash it. Returns the
/// seed that found it, 0 for none.
std::uint64_t hunt(traffic::Mutation mutation, const Arguments& arguments, std::string& how) {
    int pipes[2];
    if (pipe(pipes) != 0) return 0;
    const pid_t child = fork();
    if (child == 0) {
        close(pipes[0]);
        alarm(kSecondsPerMutation);
        traffic::planted_mutation = mutation;
        for (std::uint64_t seed = arguments.first; seed < arguments.first + arguments.seeds;
             ++seed) {
            dprintf(pipes[1], "%llu\n", static_cast<unsigned long long>(seed));
            const Outcome outcome = judge_seed(seed, {arguments.hours * 3600, 6 * 3600, false});
            if (outcome.violations.empty()) continue;
            dprintf(pipes[1], "%s\n", outcome.violations.front().c_str());
            _exit(1);
        }
        _exit(0);
    }
    close(pipes[1]);
    std::string text;
    char buffer[512];
    for (ssize_t got; (got = read(pipes[0], buffer, sizeof buffer)) > 0;) {
        text.append(buffer, static_cast<std::size_t>(got));
    }
    close(pipes[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return 0;
    std::uint64_t seed = 0;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = text.find('\n', begin);
        const std::string line = text.substr(begin, end - begin);
        if (line.find_first_not_of("0123456789") == std::string::npos) {
            seed = std::strtoull(line.c_str(), nullptr, 10);
        } else {
            how = line;
        }
        begin = end + 1;
    }
    if (WIFSIGNALED(status))
        how = "the program ended by signal " + std::to_string(WTERMSIG(status));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return 0;
    return seed;
}

int run(const Arguments& arguments) {
    const char* const names[] = {"none",
                                 "tail freed too early",
                                 "grant not atomic",
                                 "cycle test skipped",
                                 "order ignored",
                                 "breakdown forgets tiles",
                                 "closure ignored",
                                 "reopen forgets overlap",
                                 "rebuild loses base",
                                 "rebuild loses order",
                                 "rebuild loses closure",
                                 "rest not held",
                                 "swept without tail",
                                 "replan changes base",
                                 "passed counts twice",
                                 "relocation not held",
                                 "halted is released",
                                 "rollback incomplete",
                                 "successors forgotten",
                                 "visit lost",
                                 "rest crossed"};
    static_assert(std::size(names) == traffic::kMutationCount);
    int missed = 0;
    for (int m = 1; m < traffic::kMutationCount; ++m) {
        std::string how;
        const auto seed = hunt(static_cast<traffic::Mutation>(m), arguments, how);
        if (seed == 0) ++missed;
        std::printf("%-24s %s", names[m], seed == 0 ? "NOT FOUND\n" : "");
        if (seed != 0) {
            std::printf("found by seed %llu: %s\n", static_cast<unsigned long long>(seed),
                        how.c_str());
        }
        std::fflush(stdout);
    }
    const int found = traffic::kMutationCount - 1 - missed;
    std::printf("%d of %d planted bugs found\n", found, traffic::kMutationCount - 1);
    std::printf("# pass %d\n# fail %d\n", found, missed);
    return missed == 0 ? 0 : 1;
}

#else

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

#endif

}  // namespace
}  // namespace pulseline::judge

int main(int argc, char** argv) {
    return pulseline::judge::run(pulseline::judge::arguments_from(argc, argv));
}
