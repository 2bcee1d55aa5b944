// Simulation judge of the whole fleet: many seeds, each a random plant with the real fleet, real
// vehicle executors and random faults. A seed that fails prints itself and its last events;
// `--seed N` replays it identically, which every tenth seed proves. With --journal a second fleet
// follows the first one's snapshots and journal, byte for byte.
//   test_fleet_judge [--seeds N] [--first N] [--hours H] [--jobs N] [--seed N] [--trace 1]
//   [--journal 1]
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "tests/simulation/fleet_judge_world.hpp"

namespace pulseline::fleet_judge {
namespace {

constexpr std::uint64_t kTellEvery = 100;  // a minute or so
constexpr std::uint64_t kReplayEvery = 20;
/// Each in one seed of twenty at least.
constexpr const char* kFaults[] = {"message late, others overtake it",
                                   "message lost",
                                   "message doubled",
                                   "line cut",
                                   "vehicle dies and returns",
                                   "vehicle switched to manual",
                                   "vehicle has a fatal error",
                                   "vehicle paused by a person",
                                   "vehicle pushed by hand",
                                   "safety stop",
                                   "wrong pose while standing",
                                   "wrong pose while driving",
                                   "server dies",
                                   "server dies before a commit",
                                   "server dies after a commit",
                                   "commit fails",
                                   "server stands still",
                                   "long command",
                                   "store hangs",
                                   "clock step",
                                   "floor closed",
                                   "order paused",
                                   "order cancelled",
                                   "answer lost, order asked again",
                                   "person: lowerParking",
                                   "person: pick",
                                   "person: drop",
                                   "person: holds a transfer",
                                   "order: a load moved"};

struct Arguments {
    std::uint64_t first = 1;
    std::uint64_t seeds = 100;
    int jobs = 2;
    bool one = false;
    Options options;
};

Arguments arguments_from(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; i += 2) {
        const std::string name = argv[i];
        const char* value = i + 1 < argc ? argv[i + 1] : "";
        if (name == "--seeds") {
            arguments.seeds = std::strtoull(value, nullptr, 10);
        } else if (name == "--first" || name == "--seed") {
            arguments.first = std::strtoull(value, nullptr, 10);
            arguments.one = name == "--seed";
            if (arguments.one) arguments.seeds = 1;
        } else if (name == "--hours") {
            arguments.options.hours = std::strtod(value, nullptr);
        } else if (name == "--jobs") {
            arguments.jobs = std::max(1, std::atoi(value));
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
    int fewest_classes = 1 << 30;
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
        fewest_classes = std::min(fewest_classes, outcome.classes);
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

thread_local std::uint64_t seed_at_work = 0;

/// An assertion of the core ends the program: at least it says in which seed.
void tell_seed(int signal_number) {
    char text[80];
    const int length = std::snprintf(text, sizeof text, "seed %llu ended by signal %d\n",
                                     static_cast<unsigned long long>(seed_at_work), signal_number);
    if (write(STDOUT_FILENO, text, static_cast<std::size_t>(length)) < 0) _exit(3);
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

struct Judged {
    Outcome outcome;
    bool replayed = false;
};

Judged judge(std::uint64_t seed, const Arguments& arguments) {
    seed_at_work = seed;
    Judged judged{judge_seed(seed, arguments.options), false};
    Outcome& outcome = judged.outcome;
    judged.replayed = !arguments.one && (!outcome.violations.empty() || seed % kReplayEvery == 0);
    if (!judged.replayed) return judged;
    const Outcome again = judge_seed(seed, arguments.options);
    if (again.digest != outcome.digest || again.violations != outcome.violations) {
        outcome.violations.push_back("its replay went another way");
    }
    return judged;
}

/// Seeds on `jobs` threads, told in their order.
class Run {
public:
    explicit Run(const Arguments& arguments) : arguments_(arguments) {}

    Sums go() {
        std::vector<std::thread> threads;
        for (int i = 0; i < arguments_.jobs; ++i) threads.emplace_back([this] { work(); });
        for (auto& thread : threads) thread.join();
        return std::move(sums_);
    }

private:
    void work() {
        for (;;) {
            const std::uint64_t number = next_++;
            if (number >= arguments_.seeds) return;
            Judged judged = judge(arguments_.first + number, arguments_);
            const std::lock_guard lock(mutex_);
            waiting_.emplace(number, std::move(judged));
            while (!waiting_.empty() && waiting_.begin()->first == told_) {
                tell(arguments_.first + told_++, waiting_.begin()->second);
                waiting_.erase(waiting_.begin());
            }
        }
    }

    void tell(std::uint64_t seed, const Judged& judged) {
        const Outcome& outcome = judged.outcome;
        if (arguments_.one) {
            std::printf("seed %llu: digest %016llx, %d vehicles, %d orders, %.0f s\n",
                        static_cast<unsigned long long>(seed),
                        static_cast<unsigned long long>(outcome.digest), outcome.vehicles,
                        outcome.orders, outcome.end_s);
        }
        sums_.replayed += judged.replayed ? 1 : 0;
        sums_.add(outcome);
        if (!outcome.violations.empty()) {
            ++sums_.failed;
            print_failure(seed, outcome, arguments_.options);
        }
        if (told_ % kTellEvery == 0) {
            std::fprintf(stderr, "%llu of %llu seeds, %llu failed\n",
                         static_cast<unsigned long long>(told_),
                         static_cast<unsigned long long>(arguments_.seeds),
                         static_cast<unsigned long long>(sums_.failed));
        }
    }

    const Arguments& arguments_;
    std::atomic<std::uint64_t> next_{0};
    std::mutex mutex_;
    std::map<std::uint64_t, Judged> waiting_;
    std::uint64_t told_ = 0;
    Sums sums_;
};

/// What every run of many seeds must have had, or it has judged little.
bool is_wide(const Sums& sums, const Arguments& arguments) {
    if (arguments.seeds < 100) return true;
    bool wide = true;
    const auto want = [&](bool holds, const char* what) {
        if (!holds) std::printf("not judged enough: %s\n", what);
        wide &= holds;
    };
    want(5 * sums.with_faults >= 4 * arguments.seeds, "faults in 80 % of the seeds");
    want(sums.least >= 6 && sums.most <= 30 && sums.most >= 20, "6 to 30 vehicles, some with many");
    want(sums.fewest_classes >= 2, "two classes of vehicles in each seed, one of platforms");
    want(arguments.options.hours < 1 || sums.fewest_orders >= 30, "30 orders in each seed");
    want(sums.hours >= static_cast<double>(arguments.seeds) * arguments.options.hours,
         "the simulated hours");
    want(sums.replayed > 0, "a seed replayed");
    for (const char* fault : kFaults) {
        const auto found = sums.faults.find(fault);
        want(found != sums.faults.end() && 20 * found->second.second >= arguments.seeds, fault);
    }
    return wide;
}

int run(const Arguments& arguments) {
    Sums sums = Run(arguments).go();
    const auto share =
        100.0 * static_cast<double>(sums.with_faults) / static_cast<double>(arguments.seeds);
    std::printf(
        "%llu seeds, %.0f simulated hours, %d to %d vehicles of %d classes at least, %llu orders "
        "(at least %d a seed), %llu ended, %llu seeds replayed\n",
        static_cast<unsigned long long>(arguments.seeds), sums.hours, sums.least, sums.most,
        sums.fewest_classes, static_cast<unsigned long long>(sums.orders), sums.fewest_orders,
        static_cast<unsigned long long>(sums.ended),
        static_cast<unsigned long long>(sums.replayed));
    for (const auto& [name, counts] : sums.faults) {
        std::printf("  %-40s %8llu in %llu seeds\n", name.c_str(),
                    static_cast<unsigned long long>(counts.first),
                    static_cast<unsigned long long>(counts.second));
    }
    const bool wide = is_wide(sums, arguments);
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
                static_cast<unsigned long long>(sums.failed + (wide ? 0 : 1)));
    return wide && sums.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pulseline::fleet_judge

int main(int argc, char** argv) {
    using namespace pulseline::fleet_judge;
    for (const int number : {SIGABRT, SIGSEGV}) std::signal(number, tell_seed);
    return run(arguments_from(argc, argv));
}
