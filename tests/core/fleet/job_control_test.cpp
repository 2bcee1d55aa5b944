#include "core/fleet/state/job_control.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/fleet/state/views.hpp"

namespace pulseline::fleet {
namespace {

constexpr JobState kStates[] = {
    JobState::kNotAllowedToStart, JobState::kAllowedToStart, JobState::kRunning,
    JobState::kInterrupted,       JobState::kEnded,          JobState::kAborted};

JobState state_named(const std::string& name) {
    for (const JobState state : kStates) {
        if (name == to_string(state)) return state;
    }
    throw std::runtime_error("no state " + name);
}

std::string outcome(JobState from, JobMethod method) {
    const auto found = transition(from, method);
    if (!found) return "-";
    return found->removed ? "removed" : to_string(found->to);
}

TEST(JobControl, IsTheTableOfOpc10031_4) {
    std::ifstream table(PULSELINE_JOB_CONTROL_TABLE);
    ASSERT_TRUE(table);
    int pairs = 0;
    int allowed = 0;
    for (std::string line; std::getline(table, line);) {
        if (line.empty() || line[0] == '#' || line.starts_with("state,")) continue;
        std::istringstream fields(line);
        std::string state;
        std::string method;
        std::string expected;
        std::getline(fields, state, ',');
        std::getline(fields, method, ',');
        std::getline(fields, expected, ',');
        const auto called = job_method(method);
        ASSERT_TRUE(called) << line;
        EXPECT_STREQ(to_string(*called), method.c_str());

        EXPECT_EQ(outcome(state_named(state), *called), expected) << line;

        ++pairs;
        allowed += expected != "-";
    }
    EXPECT_EQ(pairs, 66);
    EXPECT_EQ(allowed, 16);
}

TEST(JobControl, KnowsNoOtherMethod) { EXPECT_FALSE(job_method("Restart")); }

}  // namespace
}  // namespace pulseline::fleet
