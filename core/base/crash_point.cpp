#include "core/base/crash_point.hpp"

#ifndef PULSELINE_CRASH_POINTS

void pulseline::crash_point(CrashPoint) {}

#else

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace pulseline {
namespace {

constexpr std::array kNames = {
#define CRASH_POINT(name, text) text,
#include "core/base/crash_points.def"
#undef CRASH_POINT
};

struct Plan {
    int point = -1;  // none
    long passage = 0;
};

/// A name nobody knows would be a test that cannot fail, so it ends the process at once.
Plan read_plan() {
    const char* text = std::getenv("PULSELINE_CRASH_AT");
    if (!text || !*text) return {};
    const std::string all = text;
    const auto colon = all.find(':');
    Plan plan;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        if (all.substr(0, colon) == kNames[i]) plan.point = static_cast<int>(i);
    }
    plan.passage = colon == std::string::npos ? 1 : std::atol(all.c_str() + colon + 1);
    if (plan.point < 0 || plan.passage < 1) {
        std::fprintf(stderr, "PULSELINE_CRASH_AT=%s: give name:n, a name of crash_points.def\n",
                     text);
        std::_Exit(70);
    }
    return plan;
}

}  // namespace

void crash_point(CrashPoint here) {
    static const Plan plan = read_plan();
    static std::atomic<long> passed{0};
    if (static_cast<int>(here) == plan.point && ++passed == plan.passage) std::raise(SIGKILL);
}

}  // namespace pulseline

#endif
