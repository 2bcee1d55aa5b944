// Planted bugs of traffic (tests/mutations/traffic.txt): the judge has to find each.
//   test_traffic_mutations [--seeds N]
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>

#include "planted.hpp"
#include "tests/simulation/judge_world.hpp"

namespace pulseline::judge {
namespace {

using traffic::kPlanted;

constexpr unsigned kSecondsPerMutation = 60;

/// Runs seeds in a child process until one fails, since a planted bug may crash it. Returns the
/// seed that found it, 0 for none.
std::uint64_t hunt(traffic::Mutation mutation, std::uint64_t seeds, std::string& how) {
    int pipes[2];
    if (pipe(pipes) != 0) return 0;
    const pid_t child = fork();
    if (child == 0) {
        close(pipes[0]);
        alarm(kSecondsPerMutation);
        traffic::planted_mutation = mutation;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            dprintf(pipes[1], "%llu\n", static_cast<unsigned long long>(seed));
            const Outcome outcome = judge_seed(seed, {3600, 6 * 3600, false});
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

int run(std::uint64_t seeds) {
    constexpr int kCount = static_cast<int>(std::size(kPlanted));
    int missed = 0;
    for (int m = 1; m < kCount; ++m) {
        std::string how;
        const auto seed = hunt(static_cast<traffic::Mutation>(m), seeds, how);
        if (seed == 0) ++missed;
        std::printf("%-24s %s", kPlanted[m].name, seed == 0 ? "NOT FOUND\n" : "");
        if (seed != 0) {
            std::printf("found by seed %llu: %s\n", static_cast<unsigned long long>(seed),
                        how.c_str());
        }
        std::fflush(stdout);
    }
    const int found = kCount - 1 - missed;
    std::printf("%d of %d planted bugs found\n", found, kCount - 1);
    std::printf("# pass %d\n# fail %d\n", found, missed);
    return missed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pulseline::judge

int main(int argc, char** argv) {
    std::uint64_t seeds = 300;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (std::strcmp(argv[i], "--seeds") != 0) {
            std::fprintf(stderr, "unknown option %s\n", argv[i]);
            return 2;
        }
        seeds = std::strtoull(argv[i + 1], nullptr, 10);
    }
    return pulseline::judge::run(seeds);
}
