#include "core/fleet/state/job_control.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace pulseline::fleet {
namespace {

constexpr std::array<std::pair<JobMethod, const char*>, 11> kNames{{
    {JobMethod::kStore, "Store"},
    {JobMethod::kStoreAndStart, "StoreAndStart"},
    {JobMethod::kStart, "Start"},
    {JobMethod::kRevokeStart, "RevokeStart"},
    {JobMethod::kPause, "Pause"},
    {JobMethod::kResume, "Resume"},
    {JobMethod::kUpdate, "Update"},
    {JobMethod::kAbort, "Abort"},
    {JobMethod::kStop, "Stop"},
    {JobMethod::kCancel, "Cancel"},
    {JobMethod::kClear, "Clear"},
}};

}  // namespace

const char* to_string(JobMethod method) {
    return std::ranges::find(kNames, method, &std::pair<JobMethod, const char*>::first)->second;
}

std::optional<JobMethod> job_method(std::string_view name) {
    for (const auto& [method, text] : kNames) {
        if (name == text) return method;
    }
    return std::nullopt;
}

std::optional<JobTransition> transition(JobState from, JobMethod method) {
    const auto to = [](JobState state) { return JobTransition{state, false}; };
    const JobTransition removed{from, true};
    const bool waits = from == JobState::kNotAllowedToStart || from == JobState::kAllowedToStart;
    const bool began = from == JobState::kRunning || from == JobState::kInterrupted;
    switch (method) {
        case JobMethod::kStore:
        case JobMethod::kStoreAndStart:
            return std::nullopt;
        case JobMethod::kStart:
            if (from == JobState::kNotAllowedToStart) return to(JobState::kAllowedToStart);
            return std::nullopt;
        case JobMethod::kRevokeStart:
            if (from == JobState::kAllowedToStart) return to(JobState::kNotAllowedToStart);
            return std::nullopt;
        case JobMethod::kPause:
            if (from == JobState::kRunning) return to(JobState::kInterrupted);
            return std::nullopt;
        case JobMethod::kResume:
            if (from == JobState::kInterrupted) return to(JobState::kRunning);
            return std::nullopt;
        case JobMethod::kUpdate:
            if (waits) return to(from);
            return std::nullopt;
        case JobMethod::kAbort:
            if (waits || began) return to(JobState::kAborted);
            return std::nullopt;
        case JobMethod::kStop:
            if (began) return to(JobState::kEnded);
            return std::nullopt;
        case JobMethod::kCancel:
            if (waits) return removed;
            return std::nullopt;
        case JobMethod::kClear:
            if (is_final(from)) return removed;
            return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace pulseline::fleet
