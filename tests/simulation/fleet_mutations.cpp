// Planted bugs of the fleet (tests/mutations/fleet.txt): each has to be found, by the fleet judge
// or, where it would take the judge too long, by a unit test of the fleet.
//   test_fleet_mutations [--seeds N] [--hours H] [--only NUMBER]
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <string>

#include "planted.hpp"
#include "tests/simulation/fleet_judge_world.hpp"

namespace pulseline::fleet_judge {
namespace {

constexpr unsigned kSecondsPerMutation = 100;
constexpr std::size_t kAtOnce = 2;
using fleet::kPlanted;  // those that no seed finds are for the unit tests

class FirstFailure : public testing::EmptyTestEventListener {
public:
    explicit FirstFailure(int out) : out_(out) {}
    void OnTestEnd(const testing::TestInfo& test) override {
        if (!test.result()->Failed()) return;
        dprintf(out_, "the unit test %s.%s\n", test.test_suite_name(), test.name());
        _exit(1);
    }

private:
    int out_;
};

[[noreturn]] void run_unit_tests(int out) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FirstFailure(out));
    dprintf(out, "all unit tests\n");
    _exit(RUN_ALL_TESTS() == 0 ? 0 : 1);
}

struct Hunt {
    int mutation = 0;
    int pipe = -1;
};

/// A child process, since a planted bug may crash it: writes each seed it begins and what it finds.
/// A seed that fails without the bug too finds nothing.
Hunt start(int mutation, std::uint64_t seeds, const Options& options, pid_t& child) {
    int pipes[2];
    if (pipe(pipes) != 0) std::exit(2);
    child = fork();
    if (child != 0) {
        close(pipes[1]);
        return {mutation, pipes[0]};
    }
    alarm(kSecondsPerMutation);
    fleet::planted_mutation = static_cast<fleet::Mutation>(mutation);
    if (kPlanted[mutation].found_by == 0) run_unit_tests(pipes[1]);
    // First the seed that found it last, which saves most of the time; then all.
    for (std::uint64_t number = 0; number <= seeds; ++number) {
        const std::uint64_t seed = number == 0 ? kPlanted[mutation].found_by : number;
        if (seed == 0) continue;
        dprintf(pipes[1], "seed %llu", static_cast<unsigned long long>(seed));
        const Outcome outcome = judge_seed(seed, options);
        if (!outcome.violations.empty()) {
            dprintf(pipes[1], ": %s\n", outcome.violations.front().c_str());
            fleet::planted_mutation = fleet::Mutation::kNone;
            if (judge_seed(seed, options).violations.empty()) _exit(1);
            dprintf(pipes[1], "seed %llu, which fails without the planted bug too\n",
                    static_cast<unsigned long long>(seed));
            _exit(0);
        }
        dprintf(pipes[1], "\n");
    }
    _exit(0);
}

/// True when the judge found it.
bool end(const Hunt& hunt, int status) {
    std::string text;
    char buffer[512];
    for (ssize_t got; (got = read(hunt.pipe, buffer, sizeof buffer)) > 0;) {
        text.append(buffer, static_cast<std::size_t>(got));
    }
    close(hunt.pipe);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    const auto line = text.substr(text.rfind('\n') + 1);
    const bool killed = WIFSIGNALED(status);
    const bool found = killed ? WTERMSIG(status) != SIGALRM : WEXITSTATUS(status) == 1;
    std::printf("%-28s %s %s%s\n", kPlanted[hunt.mutation].name,
                found ? "found by" : "NOT FOUND, ended at", line.c_str(),
                killed && found ? ": the program ended by a signal" : "");
    std::fflush(stdout);
    return found;
}

int run(std::uint64_t seeds, int only, const Options& options) {
    std::map<pid_t, Hunt> hunts;
    int found = 0;
    int planted = 0;
    const auto wait_for_one = [&] {
        int status = 0;
        const pid_t child = waitpid(-1, &status, 0);
        const auto hunt = hunts.find(child);
        if (hunt == hunts.end()) return;
        found += end(hunt->second, status) ? 1 : 0;
        hunts.erase(hunt);
    };
    for (int m = 1; m < static_cast<int>(std::size(kPlanted)); ++m) {
        if (only != 0 && m != only) continue;
        ++planted;
        while (hunts.size() >= kAtOnce) wait_for_one();
        pid_t child = 0;
        const Hunt hunt = start(m, seeds, options, child);
        hunts[child] = hunt;
    }
    while (!hunts.empty()) wait_for_one();
    std::printf("%d of %d planted bugs of the fleet found\n", found, planted);
    std::printf("# pass %d\n# fail %d\n", found, planted - found);
    return found == planted ? 0 : 1;
}

}  // namespace
}  // namespace pulseline::fleet_judge

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    std::uint64_t seeds = 100;
    int only = 0;
    pulseline::fleet_judge::Options options;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        if (name == "--seeds") {
            seeds = std::strtoull(argv[i + 1], nullptr, 10);
        } else if (name == "--hours") {
            options.hours = std::strtod(argv[i + 1], nullptr);
        } else if (name == "--only") {
            only = std::atoi(argv[i + 1]);
        } else {
            std::fprintf(stderr, "unknown option %s\n", name.c_str());
            return 2;
        }
    }
    return pulseline::fleet_judge::run(seeds, only, options);
}
